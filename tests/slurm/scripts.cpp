// The jobs' scripts, run by a shell as Slurm runs them: ended, killed and begun again.
#include "host/slurm/scripts.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <csignal>
#include <functional>
#include <memory>

#include "host/core/error.hpp"
#include "tests/cli/scene.hpp"
#include "tests/support/nasty_strings.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::slurm;
using namespace eyeray::test;

namespace {

// Jobs of a picture of two shares in a folder, without Slurm.
struct Jobs {
  SceneFolder folder;
  ArrayRequest request;

  explicit Jobs(const std::string& samples) {
    request.program = eyeray_binary();
    request.scene = folder.scene();
    request.render_words = {
        "--backend",          "twin", "-s", "240x160", "--spp", samples, "-D", "image.pattern=jittered",
        "--checkpoint-every", "0.02"};
    request.merge_words = {"-o", folder / "merged.pfm"};
    request.folder = folder / "it's here";
    request.shards = 2;
    std::filesystem::create_directory(request.folder);
    write_text(file("share.sh"), share_script(request));
    write_text(file("merge.sh"), merge_script(request));
  }
  std::string file(const std::string& name) const { return request.folder / name; }
  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(request.folder))
      names.insert(entry.path().filename());
    return names;
  }
  std::unique_ptr<Process> start(int number) const {
    // By one processor, so that it takes long enough to be ended on any machine.
    cpu_set_t set;
    REQUIRE(sched_getaffinity(0, sizeof set, &set) == 0);
    int first = 0;
    while (!CPU_ISSET(first, &set)) ++first;
    return std::make_unique<Process>(
        std::vector<std::string>{"taskset", "-c", std::to_string(first), "sh", file("share.sh"), "0"},
        Environment{{"SLURM_ARRAY_TASK_ID", std::to_string(number)}, {"SLURMD_NODENAME", "n7"}});
  }
  int run(int number) const {
    const auto job = start(number);
    REQUIRE(job->wait(3600));
    return *job->code();
  }
};

// The process that the shell waits for; 0 where there is none yet.
pid_t child_of(const Process& shell) {
  const std::string pid = std::to_string(shell.pid());
  return pid_t(std::atol(read_text("/proc/" + pid + "/task/" + pid + "/children").c_str()));
}

bool wait_until(Process& job, const std::function<bool()>& condition) {
  const Stopwatch watch;
  while (!condition()) {
    if (job.code() || watch.seconds() > 600) return false;
    job.wait(0.01);
  }
  return true;
}

}  // namespace

TEST_CASE("a share that is ended, killed and begun again goes on, and leaves nothing but its part") {
  const Jobs jobs("144");
  const std::string checkpoint = jobs.file("1.work");
  const auto resumes = [&](const Process& job) {
    const std::string words = read_text(fmt::format("/proc/{}/cmdline", child_of(job)));
    return words.find("--resume") != std::string::npos;
  };
  // As Slurm ends a job that is preempted, or at its limit on time.
  {
    const auto job = jobs.start(1);
    REQUIRE(wait_until(*job, [&] { return std::filesystem::exists(checkpoint); }));
    CHECK_FALSE(resumes(*job));
    job->send_signal(SIGTERM);
    REQUIRE(job->wait(600));
    CHECK(job->code() == 143);
    CHECK(read_text(jobs.file("1.failed")).starts_with("143 n7\n"));
    CHECK(std::filesystem::exists(checkpoint));
  }
  // As a node that goes.
  {
    const auto job = jobs.start(1);
    REQUIRE(wait_until(*job, [&] { return resumes(*job); }));
    CHECK_FALSE(std::filesystem::exists(jobs.file("1.failed")));
    const auto begun = std::filesystem::last_write_time(checkpoint);
    REQUIRE(wait_until(*job, [&] { return std::filesystem::last_write_time(checkpoint) != begun; }));
    const pid_t child = child_of(*job);
    job->send_signal(SIGKILL);
    ::kill(child, SIGKILL);
    REQUIRE(job->wait(600));
    REQUIRE(wait_until_ended(child));
  }
  CHECK(jobs.run(1) == 0);
  // A checkpoint that is damaged is thrown away.
  write_text(jobs.file("2.work"), "EYERAYCP and then nothing of it");
  CHECK(jobs.run(2) == 0);
  CHECK(jobs.names() ==
        std::set<std::string>{"1-of-2.eyeray", "1.log", "2-of-2.eyeray", "2.log", "share.sh", "merge.sh"});
  // Begun once more, one that is done does nothing.
  const auto written = std::filesystem::last_write_time(jobs.file("1-of-2.eyeray"));
  CHECK(jobs.run(1) == 0);
  CHECK(std::filesystem::last_write_time(jobs.file("1-of-2.eyeray")) == written);

  CHECK(run_process({"sh", jobs.file("merge.sh")}, {}, 600).code == 0);
  CHECK(std::filesystem::exists(jobs.file("merged")));
  std::vector<std::string> whole{"render", jobs.folder.scene(), "-o", jobs.folder / "whole.pfm"};
  whole.insert(whole.end(), jobs.request.render_words.begin(), jobs.request.render_words.end() - 2);
  REQUIRE(run_eyeray(whole).code == 0);
  CHECK((read_text(jobs.folder / "whole.pfm") == read_text(jobs.folder / "merged.pfm")));
}

TEST_CASE("a script leaves the code, the node and the words of what failed") {
  const Jobs jobs("0");
  CHECK(jobs.run(1) == 2);
  const std::string words = read_text(jobs.file("1.failed"));
  CHECK(words.starts_with("2 n7\n"));
  CHECK(words.size() > std::string("2 n7\n").size());
  // The merge has nothing to merge.
  CHECK(run_process({"sh", jobs.file("merge.sh")}, {}, 600).code == 4);
  CHECK(read_text(jobs.file("merge.failed")).starts_with("4 "));
  CHECK_FALSE(std::filesystem::exists(jobs.file("merged")));
}

TEST_CASE("shares of frames render every N-th of them each, and the last job makes the video") {
  Jobs jobs("4");
  write_text(jobs.folder.scene(), std::string(small_scene) + R"(
[[track]]
target = "sphere.0.center"
keyframes = [[0, [-2, 1, 0]], [10, [2, 1, 0]]]
)");
  jobs.request.render_words = {"--backend", "twin"};
  jobs.request.frame_words = {"--frames", "0:4", "-o", jobs.folder / "f%d.png"};
  jobs.request.video = jobs.folder / "it's.mp4";
  write_text(jobs.file("share.sh"), share_script(jobs.request));
  write_text(jobs.file("merge.sh"), merge_script(jobs.request));
  const auto frame = [&](int i) { return jobs.folder / fmt::format("f{}.png", i); };

  write_text(frame(2), "mine");  // there already, as after a job that was cut off
  CHECK(jobs.run(1) == 0);
  CHECK(std::filesystem::exists(jobs.file("1-of-2.eyeray")));
  for (const int i : {0, 2, 4}) CHECK(std::filesystem::exists(frame(i)));
  for (const int i : {1, 3}) CHECK_FALSE(std::filesystem::exists(frame(i)));
  CHECK(read_text(frame(2)) == "mine");
  CHECK(jobs.run(2) == 0);
  REQUIRE(run_eyeray({"render", jobs.folder.scene(), "--backend", "twin", "-q", "-D", "animation.frame=3",
                      "-o", jobs.folder / "three.png"})
              .code == 0);
  CHECK((read_text(frame(3)) == read_text(jobs.folder / "three.png")));

  // A stand-in for ffmpeg, which copies the list of frames to its last argument.
  write_text(jobs.folder / "ffmpeg",
             "#!/bin/sh\nfor last; do :; done\n[ \"$1\" = -version ] && exit 0\n"
             "while [ \"$1\" != -i ]; do shift; done\ncp \"$2\" \"$last\"\n");
  std::filesystem::permissions(jobs.folder / "ffmpeg", std::filesystem::perms::owner_all);
  const std::string path = jobs.folder.path().string() + ":" + std::getenv("PATH");
  CHECK(run_process({"sh", jobs.file("merge.sh")}, {{"PATH", path}}, 600).code == 0);
  CHECK(std::filesystem::exists(jobs.file("merged")));
  CHECK(read_text(jobs.request.video).find("f4.png") != std::string::npos);
}

TEST_CASE("a job's program gets the words that were given, from any folder, whatever they hold") {
  for (const std::string& text : nasty_strings) {
    if (text.find('\0') != std::string::npos) continue;  // no word holds it
    CAPTURE(text);
    const TemporaryFolder folder;
    ArrayRequest request;
    request.program = folder / ("x" + text + "/program");
    request.scene = text;
    request.render_words = {"-D", text};
    request.merge_words = {"-o", text};
    request.folder = folder / ("y" + text);
    std::filesystem::create_directories(std::filesystem::path(request.program).parent_path());
    std::filesystem::create_directories(request.folder);
    write_text(request.program, "#!/bin/sh\nprintf '%s\\n' \"$@\" >>\"$WORDS\"\n");
    std::filesystem::permissions(request.program, std::filesystem::perms::owner_all);
    write_text(request.folder / "share.sh", share_script(request));
    write_text(request.folder / "merge.sh", merge_script(request));
    write_text(request.folder / "1-of-1.eyeray", "");
    const Environment words{{"WORDS", folder / "words"}};
    CHECK(run_process({"sh", request.folder / "merge.sh"}, words, 600).code == 0);
    const std::string part = (request.folder / "1-of-1.eyeray").string();
    CHECK(read_text(folder / "words") == "merge\n" + part + "\n--quiet\n-o\n" + text + "\n");

    std::filesystem::remove(part);
    std::filesystem::remove(folder / "words");
    Environment task = words;
    task.emplace_back("SLURM_ARRAY_TASK_ID", "1");
    CHECK(run_process({"sh", request.folder / "share.sh", "0"}, task, 600).code == 0);
    CHECK(read_text(folder / "words").starts_with("render\n" + text + "\n-D\n" + text + "\n--quiet\n"));
  }
}
