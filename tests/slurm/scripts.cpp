// The jobs' scripts, run by a shell as Slurm runs them: ended, killed and begun again.
#include "host/slurm/array.hpp"

#include <fmt/format.h>
#include <sched.h>

#include <csignal>
#include <functional>
#include <memory>

#include "fake_slurm.hpp"
#include "tests/cli/scene.hpp"
#include "tests/support/nasty_strings.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::slurm;
using namespace eyeray::engine::test;

namespace {

// The jobs of a picture in two shares, run in a folder without Slurm.
struct Jobs {
  SceneFolder folder;
  Array array;

  Jobs() {
    array.program = eyeray_binary();
    array.render_words = {folder.scene(),          "--backend", "twin", "-s", "240x160", "--spp", "144", "-D",
                          "image.pattern=jittered"};
    array.last_words = {"-o", folder / "merged.pfm"};
    array.folder = folder / "it's here";
    array.shards = 2;
    std::filesystem::create_directory(array.folder);
  }
  std::string file(const std::string& name) const { return array.folder / name; }
  void write_scripts() const {
    write_text(file("share.sh"), share_script(array));
    write_text(file("merge.sh"), merge_script(array));
  }
  std::unique_ptr<Process> start(int number) const {
    // The job has one processor, so that it takes long enough to be interrupted on any machine.
    cpu_set_t set;
    REQUIRE(sched_getaffinity(0, sizeof set, &set) == 0);
    int first = 0;
    while (!CPU_ISSET(first, &set)) ++first;
    return std::make_unique<Process>(
        std::vector<std::string>{"taskset", "-c", std::to_string(first), "sh", file("share.sh"), "0"},
        Environment{{"SLURM_ARRAY_TASK_ID", std::to_string(number)}, {"SLURM_JOB_ID", "17"}});
  }
  int run(int number) const {
    const auto job = start(number);
    REQUIRE(job->wait(3600));
    return *job->code();
  }
  int merge() const { return run_process({"sh", file("merge.sh")}, {}, 600).code; }
};

// The process that the shell waits for; 0 where there is none yet.
pid_t child_of(const Process& shell) {
  const std::string pid = std::to_string(shell.pid());
  return pid_t(std::atol(read_text("/proc/" + pid + "/task/" + pid + "/children").c_str()));
}

bool resumes(const Process& job) {
  const std::string words = read_text(fmt::format("/proc/{}/cmdline", child_of(job)));
  return words.find("--resume") != std::string::npos;
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

TEST_CASE("an ended or killed share continues when started again, and leaves only its part") {
  const FakeSlurm slurm;
  Jobs jobs;
  jobs.array.render_words.insert(jobs.array.render_words.end(), {"--checkpoint-every", "0.02"});
  jobs.write_scripts();
  const std::string checkpoint = jobs.file("1.work");
  // A failed job has eyeray's own exit code.
  CHECK(jobs.run(3) == 2);
  CHECK(jobs.merge() == 4);
  // The signals with which Slurm ends a preempted job, and warns one that is near its time limit.
  for (const int signal : {SIGTERM, SIGUSR1}) {
    const auto job = jobs.start(1);
    REQUIRE(wait_until(
        *job, [&] { return signal == SIGTERM ? std::filesystem::exists(checkpoint) : resumes(*job); }));
    job->send_signal(signal);
    REQUIRE(job->wait(600));
    CHECK(job->code() == 143);
    CHECK(std::filesystem::exists(checkpoint));
    CHECK(slurm.read("controlled") == (signal == SIGUSR1 ? "requeue 17\n" : ""));
  }
  // The job ends as on a failed node.
  {
    const auto job = jobs.start(1);
    REQUIRE(wait_until(*job, [&] { return resumes(*job); }));
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
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(jobs.array.folder))
    names.insert(entry.path().filename());
  CHECK(names == std::set<std::string>{"1-of-2.eyeray", "2-of-2.eyeray", "share.sh", "merge.sh"});
  // A finished job that is started once more does nothing.
  const auto written = std::filesystem::last_write_time(jobs.file("1-of-2.eyeray"));
  CHECK(jobs.run(1) == 0);
  CHECK(std::filesystem::last_write_time(jobs.file("1-of-2.eyeray")) == written);

  CHECK(jobs.merge() == 0);
  CHECK(std::filesystem::exists(jobs.file("merged")));
  std::vector<std::string> whole{"render", "-o", jobs.folder / "whole.pfm"};
  whole.insert(whole.end(), jobs.array.render_words.begin(), jobs.array.render_words.end() - 2);
  REQUIRE(run_eyeray(whole).code == 0);
  CHECK((read_text(jobs.folder / "whole.pfm") == read_text(jobs.folder / "merged.pfm")));
}

TEST_CASE("a job's program gets its arguments unchanged, from any folder, whatever they contain") {
  for (const std::string& text : nasty_strings) {
    if (text.find('\0') != std::string::npos) continue;  // no argument can contain it
    CAPTURE(text);
    const TemporaryFolder folder;
    Array array;
    array.program = folder / ("x" + text + "/program");
    array.render_words = {text};
    array.last_words = {"-o", text};
    array.folder = folder / ("y" + text);
    std::filesystem::create_directories(std::filesystem::path(array.program).parent_path());
    std::filesystem::create_directories(array.folder);
    write_text(array.program, "#!/bin/sh\nprintf '%s\\n' \"$@\" >>\"$WORDS\"\n");
    std::filesystem::permissions(array.program, std::filesystem::perms::owner_all);
    write_text(array.folder / "share.sh", share_script(array));
    write_text(array.folder / "merge.sh", merge_script(array));
    write_text(array.folder / "1-of-1.eyeray", "");
    const Environment words{{"WORDS", folder / "words"}};
    CHECK(run_process({"sh", array.folder / "merge.sh"}, words, 600).code == 0);
    const std::string part = (array.folder / "1-of-1.eyeray").string();
    CHECK(read_text(folder / "words") == "merge\n" + part + "\n--quiet\n-o\n" + text + "\n");

    std::filesystem::remove(part);
    std::filesystem::remove(folder / "words");
    Environment task = words;
    task.emplace_back("SLURM_ARRAY_TASK_ID", "1");
    CHECK(run_process({"sh", array.folder / "share.sh", "0"}, task, 600).code == 0);
    CHECK(read_text(folder / "words").starts_with("render\n" + text + "\n--quiet\n"));
  }
}
