// Arrays on a real Slurm: they make the picture of one machine, however their jobs end.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cluster.hpp"
#include "fake_slurm.hpp"
#include "tests/cli/scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

using Words = std::vector<std::string>;
using Json = nlohmann::json;

// One cluster for all cases, because it takes seconds to start.
Cluster& cluster() {
  static Cluster one;
  return one;
}

template <typename Condition>
bool happens(const Condition& condition) {
  const Stopwatch watch;
  while (!condition()) {
    if (watch.seconds() > 600) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

// A scene, and the options with which Slurm renders it.
class ArrayOf {
 public:
  explicit ArrayOf(Words options, const std::string& folder = "work") : options_(std::move(options)) {
    work_ = folder_ / folder;
  }

  const SceneFolder& folder() const { return folder_; }
  std::string work(const std::string& name) const { return work_ + "/" + name; }
  ProcessResult run(const Words& more = {}, const Environment& more_environment = {}) const {
    Environment environment = cluster().environment();
    environment.insert(environment.end(), more_environment.begin(), more_environment.end());
    Words command{"slurm", folder_.scene(), "--shards", "3", "--folder", work_, "--json"};
    for (const Words& words : {options_, more}) command.insert(command.end(), words.begin(), words.end());
    return run_eyeray(command, environment);
  }
  // The command's report on the picture, as JSON.
  Json report(const Words& more = {}, const Environment& environment = {}) const {
    const ProcessResult result = run(more, environment);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
    return Json::parse(result.out).at("pictures").at(0);
  }
  // Waits until no job of the array is in the queue.
  Json ended() const {
    Json last;
    CHECK(happens([&] { return (last = report({"--no-submit"})).at("queue").empty(); }));
    return last;
  }
  bool is_whole() const {
    Words render{"render", folder_.scene(), "--quiet", "-o", folder_ / "whole.pfm"};
    render.insert(render.end(), options_.begin(), options_.end() - 2);  // without the options' -o
    REQUIRE(run_eyeray(render).code == 0);
    return read_text(folder_ / "whole.pfm") == read_text(options_.back());
  }
  Words merged() const { return {"-o", folder_ / "merged.pfm"}; }
  void add(const Words& words) { options_.insert(options_.end(), words.begin(), words.end()); }

 private:
  SceneFolder folder_;
  std::string work_;
  Words options_;
};

// A picture that is rendered at once, and one that takes long enough to be interrupted.
const Words quick{"--backend", "twin"};
const Words slow{"--backend", "twin", "-s", "240x160", "--spp", "64", "-D", "image.pattern=jittered"};

}  // namespace

TEST_CASE("an array makes the picture of one machine, and reports its progress") {
  ArrayOf array(quick);
  array.add(array.merged());
  const Json first = array.report({"--", "--comment=mine"});
  CHECK(first.at("missing") == Json{1, 2, 3});
  REQUIRE(first.at("submitted").size() == 2);
  const Json done = array.ended();
  CHECK(done.at("done") == true);
  CHECK(done.at("files") == Json{array.folder() / "merged.pfm"});
  CHECK(array.is_whole());
  CHECK(cluster()
            .ask({"scontrol", "-o", "show", "job", first.at("submitted").at(0).get<std::string>()})
            .out.find("Comment=mine") != std::string::npos);
  // Existing parts are not rendered again; another picture's parts are not used.
  CHECK(array.report().at("submitted").empty());
  write_text(array.folder().scene(), read_text(array.folder().scene()) + "\n# changed\n");
  CHECK(array.run().code == 2);
}

TEST_CASE("a cancelled or requeued array continues with the same command" * doctest::test_suite("long")) {
  ArrayOf array(slow);
  array.add(array.merged());
  const Json first = array.report();
  const auto job = first.at("submitted").at(0).get<std::string>();
  const auto runs = [&] { return array.report().at("queue").dump().find("RUNNING") != std::string::npos; };
  REQUIRE(happens(runs));
  // Nothing is submitted twice.
  CHECK(array.report().at("submitted").empty());
  // Requeues the task as preemption does.
  CHECK(cluster().ask({"scontrol", "requeue", job + "_1"}).code == 0);
  REQUIRE(happens(runs));
  CHECK(cluster().ask({"scancel", "--name=" + first.at("job_name").get<std::string>()}).code == 0);
  CHECK(array.ended().at("done") == false);
  CHECK(array.report().at("submitted").size() == 2);
  CHECK(array.ended().at("done") == true);
  CHECK(array.is_whole());
}

TEST_CASE("a share near its time limit is requeued" * doctest::test_suite("long")) {
  ArrayOf array({"--backend", "twin", "-s", "640x480", "--spp", "65536"});
  array.add(array.merged());
  // With a time limit of one minute, a warning 60 s before the end comes at once.
  const Json first = array.report({"--", "--time=1"});
  CHECK(happens([&] {
    const auto jobs =
        cluster().ask({"scontrol", "-o", "show", "job", first.at("submitted").at(0).get<std::string>()});
    return jobs.out.find(" Restarts=1 ") != std::string::npos;
  }));
  cluster().ask({"scancel", "--name=" + first.at("job_name").get<std::string>()});
  array.ended();
}

TEST_CASE("a node without Vulkan reports it in the file that the command names") {
  ArrayOf array({});
  array.add(array.merged());
  array.report({}, {{"EYERAY_VULKAN_LOADER", "/nowhere/libvulkan.so.1"}});
  CHECK(array.ended().at("missing").size() == 3);
  CHECK(array.run({"--no-submit"}).err.find("output of the failed jobs: " + array.work("1.output")) !=
        std::string::npos);
  CHECK(read_text(array.work("1.output")).find("Vulkan") != std::string::npos);
}

TEST_CASE("an array's folder may have any name without a backslash") {
  for (const std::string name : {"-x", "100%j", "it's %%A"}) {
    CAPTURE(name);
    ArrayOf array(quick, name);
    array.add(array.merged());
    array.report();
    CHECK(array.ended().at("done") == true);
    for (const char* output : {"1.output", "3.output", "merge.output"})
      CHECK(std::filesystem::exists(array.work(output)));
  }
  CHECK(ArrayOf(quick, "a \\ b").run().code == 2);
}

TEST_CASE("an animation is an array of shares of its frames") {
  ArrayOf array(quick);
  write_text(array.folder().scene(), std::string(small_scene) + R"(
[[track]]
target = "sphere.0.radius"
keyframes = [[0, 1], [10, 0.2]]
)");
  // A stand-in for ffmpeg, which copies the list of frames to its last argument.
  const FakePrograms programs;
  programs.add("ffmpeg",
               "for last; do :; done\n[ \"$1\" = -version ] && exit 0\n"
               "while [ \"$1\" != -i ]; do shift; done\ncp \"$2\" \"$last\"\n");
  array.add({"--frames", "0:4", "-o", array.folder() / "f%02d.png", "--video", array.folder() / "it's.mp4"});
  CHECK(array.report().at("submitted").size() == 2);
  const Json done = array.ended();
  CHECK(done.at("done") == true);
  CHECK(done.at("files").size() == 6);
  CHECK(read_text(array.folder() / "it's.mp4").find("f04.png") != std::string::npos);
  std::filesystem::remove(array.folder() / "f04.png");
  CHECK(array.report().at("missing") == Json{2});
  CHECK(array.ended().at("done") == true);
}

TEST_CASE("without Slurm, or with options that eyeray sets itself, the command ends at once") {
  const SceneFolder folder;
  Words command{"slurm", folder.scene(), "--shards", "2", "--folder", folder / "work"};
  const ProcessResult nothing = run_eyeray(command, {{"PATH", "/nowhere"}});
  CHECK(nothing.code == 4);
  CHECK(nothing.err.find("is not installed here") != std::string::npos);
  command.insert(command.end(), {"--", "--array=1-4"});
  const ProcessResult own = run_eyeray(command);
  CHECK(own.code == 2);
  CHECK(own.err.find("--array is set by eyeray") != std::string::npos);
}
