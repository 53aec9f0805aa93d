// Arrays on a real Slurm: they make the picture of one machine, whatever happens to their jobs.
#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "cluster.hpp"
#include "tests/cli/scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::test;

namespace {

using Words = std::vector<std::string>;

Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// One for all cases: it takes seconds to start.
Cluster& cluster() {
  static Cluster one;
  return one;
}

// A scene, its picture by one machine, and how Slurm is to render it.
class ArrayOf {
 public:
  explicit ArrayOf(const Words& options, int shards = 3)
      : command_(Words{"slurm", folder_.scene(), "--shards", std::to_string(shards), "--folder", work(),
                       "--poll", "0.1", "-o", folder_ / "merged.pfm"} +
                 options) {
    const Words render = Words{"render", folder_.scene(), "--quiet", "-o", folder_ / "whole.pfm"} + options;
    REQUIRE(run_eyeray(render).code == 0);
  }

  std::string work() const { return folder_ / "work"; }
  const SceneFolder& folder() const { return folder_; }
  Environment environment() const { return cluster().environment(); }
  ProcessResult run(const Words& more = {}, const Environment& more_environment = {}) const {
    Environment all = environment();
    all.insert(all.end(), more_environment.begin(), more_environment.end());
    return run_eyeray(command_ + more, all);
  }
  std::unique_ptr<Process> start() const {
    return std::make_unique<Process>(Words{eyeray_binary()} + command_, environment());
  }
  int array() const {
    return nlohmann::json::parse(read_text(work() + "/render.json")).at("arrays").at(0).at(0);
  }
  bool is_whole() const { return read_text(folder_ / "whole.pfm") == read_text(folder_ / "merged.pfm"); }

 private:
  SceneFolder folder_;
  Words command_;
};

// A render that takes long enough to be hit.
const Words slow{"--backend", "twin", "-s", "240x160", "--spp", "64", "-D", "image.pattern=jittered"};
const Words quick{"--backend", "twin"};

// The process whose words have `word` among them; 0 where none has.
pid_t process_with(const std::string& word, const std::string& other) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string words = read_text(entry.path() / "cmdline");
    const bool is_eyeray = words.starts_with(eyeray_binary());
    if (is_eyeray && words.find(word) != std::string::npos && words.find(other) != std::string::npos)
      return pid_t(std::stol(name));
  }
  return 0;
}

template <typename Condition>
bool happens(const Condition& condition) {
  const Stopwatch watch;
  while (!condition()) {
    if (watch.seconds() > 600) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return true;
}

}  // namespace

TEST_CASE("an array makes the picture of one machine, and says how far it is") {
  const ArrayOf array(quick);
  const ProcessResult result = array.run({"--json", "--", "--job-name=mine"});
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  CHECK(array.is_whole());
  CHECK(result.err.find("0 of 3 parts") != std::string::npos);
  CHECK(result.err.find("3 of 3 parts, merged\n") != std::string::npos);
  const auto said = nlohmann::json::parse(result.out);
  CHECK(said.at("files") == nlohmann::json{array.folder() / "merged.pfm"});
  CHECK(said.at("retried") == 0);
  CHECK(cluster()
            .ask({"scontrol", "-o", "show", "job", std::to_string(array.array())})
            .out.find("JobName=mine") != std::string::npos);

  // What is there is not rendered again; another picture's parts are not taken.
  const int first = array.array();
  CHECK(array.run().code == 0);
  CHECK(array.array() == first);
  write_text(array.folder().scene(), read_text(array.folder().scene()) + "\n# changed\n");
  const ProcessResult other = array.run();
  CHECK(other.code == 2);
  CHECK(other.err.find("holds parts of another picture") != std::string::npos);
}

TEST_CASE("a share that is killed is rendered again, from its checkpoint on" * doctest::test_suite("long")) {
  const ArrayOf array(slow + Words{"-D", "render.max_depth=3"});
  const auto watcher = array.start();
  pid_t killed = 0;
  REQUIRE(happens([&] {
    watcher->wait(0.01);
    killed = process_with("2/3", array.work());
    return killed > 0;
  }));
  ::kill(killed, SIGKILL);
  REQUIRE(watcher->wait(3600));
  CAPTURE(watcher->err());
  CHECK(watcher->code() == 0);
  CHECK(array.is_whole());
}

TEST_CASE("a share that is requeued, as by preemption, goes on under its job's number" *
          doctest::test_suite("long")) {
  const ArrayOf array(slow + Words{"-D", "render.max_depth=3"});
  const auto watcher = array.start();
  REQUIRE(happens([&] {
    watcher->wait(0.01);
    return process_with("1/3", array.work()) > 0;
  }));
  const int job = array.array();
  CHECK(cluster().ask({"scontrol", "requeue", fmt::format("{}_1", job)}).code == 0);
  REQUIRE(watcher->wait(3600));
  CAPTURE(watcher->err());
  CHECK(watcher->code() == 0);
  CHECK(array.array() == job);
  CHECK(array.is_whole());
}

TEST_CASE("the watching may be interrupted, and taken up again" * doctest::test_suite("long")) {
  const ArrayOf array(slow);
  const auto watcher = array.start();
  REQUIRE(happens([&] { return watcher->wait_for_error_text("0 of 3 parts", 1); }));
  watcher->send_signal(SIGINT);
  REQUIRE(watcher->wait(600));
  CHECK(watcher->code() == 130);
  const int job = array.array();
  CHECK(watcher->err().find(fmt::format("the same command shows them again, and scancel {} ", job)) !=
        std::string::npos);
  const ProcessResult rest = array.run();
  CAPTURE(rest.err);
  CHECK(rest.code == 0);
  CHECK(array.array() == job);
  CHECK(array.is_whole());
}

TEST_CASE("a cancelled array is told, and not begun again by itself" * doctest::test_suite("long")) {
  const ArrayOf array(slow);
  const auto watcher = array.start();
  REQUIRE(happens([&] { return watcher->wait_for_error_text(" running", 1); }));
  const int job = array.array();
  REQUIRE(cluster().ask({"scancel", std::to_string(job)}).code == 0);
  REQUIRE(watcher->wait(3600));
  CHECK(watcher->code() == 130);
  CHECK(watcher->err().find(fmt::format("the array {}", job)) != std::string::npos);
  CHECK(watcher->err().find("was cancelled with ") != std::string::npos);
  const ProcessResult rest = array.run();
  CAPTURE(rest.err);
  CHECK(rest.code == 0);
  CHECK(array.is_whole());
}

TEST_CASE("a node without Vulkan says so, and is not asked for ever") {
  const ArrayOf array(Words{}, 2);
  const ProcessResult result =
      array.run({"--retries", "1"}, {{"EYERAY_VULKAN_LOADER", "/nowhere/libvulkan.so.1"}});
  CAPTURE(result.err);
  CHECK(result.code == 3);
  CHECK(result.err.find("share 1/2 on ") != std::string::npos);
  CHECK(result.err.find(", tried 2 times: ") != std::string::npos);
  CHECK(result.err.find("Vulkan") != std::string::npos);
  // Nothing of it is left in the queue.
  CHECK(happens([&] { return cluster().ask({"squeue", "-h"}).out.empty(); }));
}

TEST_CASE("the folder of an array may have any name without a backslash") {
  for (const std::string name : {"-x", "100%j", "it's %%A", "a \\ b"}) {
    CAPTURE(name);
    const SceneFolder folder;
    const std::string work = folder / name;
    const ProcessResult result = run_eyeray(Words{"slurm", folder.scene(), "--shards", "2", "--folder", work,
                                                  "--poll", "0.1", "-o", folder / "merged.pfm"} +
                                                quick,
                                            cluster().environment());
    CAPTURE(result.err);
    if (name.find('\\') != std::string::npos) {
      CHECK(result.code == 2);
      CHECK(result.err.find("backslash") != std::string::npos);
      continue;
    }
    CHECK(result.code == 0);
    CHECK(std::filesystem::exists(folder / "merged.pfm"));
    std::set<std::string> outputs;
    for (const auto& entry : std::filesystem::directory_iterator(work))
      if (entry.path().extension() == ".output") outputs.insert(entry.path().filename());
    CHECK(outputs.size() == 3);
    CHECK(outputs.contains("merge.output"));
  }
}

TEST_CASE("a folder that vanishes is told" * doctest::test_suite("long")) {
  const ArrayOf array(slow);
  const auto watcher = array.start();
  REQUIRE(happens([&] { return watcher->wait_for_error_text(" running", 1); }));
  const int job = array.array();
  std::filesystem::rename(array.work(), array.folder() / "elsewhere");
  REQUIRE(watcher->wait(3600));
  CHECK(watcher->code() == 4);
  CHECK(watcher->err().find("work is gone, and with it the parts") != std::string::npos);
  cluster().ask({"scancel", std::to_string(job)});
  CHECK(happens([&] { return cluster().ask({"squeue", "-h"}).out.empty(); }));
}

TEST_CASE("a part that is damaged is named by the merge" * doctest::test_suite("long")) {
  const ArrayOf array(quick);
  REQUIRE(array.run().code == 0);
  const std::string part = array.work() + "/2-of-3.eyeray";
  std::string damaged = read_text(part);
  damaged[damaged.size() / 2] = char(damaged[damaged.size() / 2] ^ 1);
  write_text(part, damaged);
  std::filesystem::remove(array.work() + "/merged");
  const ProcessResult result = array.run();
  CHECK(result.code == 4);
  CHECK(result.err.find("the merge failed: ") != std::string::npos);
  CHECK(result.err.find("2-of-3.eyeray: it is damaged: its checksum is wrong") != std::string::npos);
}

TEST_CASE("an animation is an array of shares of its frames") {
  const SceneFolder folder;
  write_text(folder.scene(), std::string(small_scene) + R"(
[[track]]
target = "sphere.0.radius"
keyframes = [[0, 1], [10, 0.2]]
)");
  const Words command{"slurm", folder.scene(),       "--frames",      "0:4",    "--shards",
                      "2",     "--folder",           folder / "work", "--poll", "0.1",
                      "-o",    folder / "f%02d.pfm", "--backend",     "twin",   "--json"};
  const ProcessResult result = run_eyeray(command, cluster().environment());
  CAPTURE(result.err);
  REQUIRE(result.code == 0);
  CHECK(nlohmann::json::parse(result.out).at("files").size() == 5);
  CHECK(run_eyeray({"render", folder.scene(), "--backend", "twin", "-q", "-D", "animation.frame=4", "-o",
                    folder / "four.pfm"})
            .code == 0);
  CHECK((read_text(folder / "f04.pfm") == read_text(folder / "four.pfm")));
}

TEST_CASE("without Slurm, and with words that are eyeray's own, it ends at once") {
  const SceneFolder folder;
  const Words command{"slurm", folder.scene(), "--shards", "2", "--folder", folder / "work"};
  const ProcessResult nothing = run_eyeray(command, {{"PATH", "/nowhere"}});
  CHECK(nothing.code == 4);
  CHECK(nothing.err.find("there is no ") != std::string::npos);
  const ProcessResult own = run_eyeray(command + Words{"--", "--array=1-4"});
  CHECK(own.code == 2);
  CHECK(own.err.find("--array is eyeray's to say") != std::string::npos);
}
