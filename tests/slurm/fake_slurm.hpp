// Slurm's commands as scripts that answer what a test wants: states that a real one takes minutes to reach,
// or reaches only when something breaks.
#pragma once

#include <fmt/format.h>

#include <cstdlib>

#include "tests/support/process.hpp"

namespace eyeray::test {

// In this process's PATH as long as it lives.
class FakeSlurm {
 public:
  FakeSlurm() {
    for (const auto& [name, script] :
         {std::pair("sbatch",
                    "echo \"$@\" >>\"$folder/submitted\"\n"
                    "job=$(wc -l <\"$folder/submitted\")\n"
                    "[ \"$job\" -gt \"$(cat \"$folder/most\")\" ] && { echo 'sbatch: error: no more' >&2; "
                    "exit 1; }\n"
                    "echo \"$job;cluster\"\n"),
          std::pair("scontrol",
                    "[ -e \"$folder/down\" ] && { cat \"$folder/down\" >&2; exit 1; }\n"
                    "[ \"$2\" = config ] && { echo 'MaxArraySize            = 1001'; exit 0; }\n"
                    "cat \"$folder/job.$4\" 2>/dev/null && exit 0\n"
                    "echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1\n"),
          std::pair("sacct",
                    "cat \"$folder/accounts.$5\" 2>/dev/null && exit 0\n"
                    "echo 'Slurm accounting storage is disabled' >&2; exit 1\n")}) {
      write_text(folder_ / name, "#!/bin/sh\nfolder=" + folder_.path().string() + "\n" + script);
      std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
    }
    allow(1000);
    ::setenv("PATH", (folder_.path().string() + ":" + path_).c_str(), 1);
  }
  ~FakeSlurm() { ::setenv("PATH", path_.c_str(), 1); }

  // From now on `most` submissions are taken, in all.
  void allow(int most) { write_text(folder_ / "most", std::to_string(most)); }
  // What it says of a job's tasks, "1-3", with a state each; nothing where it has forgotten the job.
  void set(int job, const std::vector<std::pair<std::string, std::string>>& tasks) {
    std::string text;
    for (const auto& [list, state] : tasks)
      text += fmt::format("JobId={0} ArrayJobId={0} ArrayTaskId={1} JobState={2} Reason=None BatchHost=n1\n",
                          job, list, state);
    write_text(folder_ / fmt::format("job.{}", job), text);
  }
  void forget(int job) { std::filesystem::remove(folder_ / fmt::format("job.{}", job)); }
  // A job that is no array.
  void set(int job, const std::string& state) {
    write_text(folder_ / fmt::format("job.{}", job),
               fmt::format("JobId={} JobState={} Reason=None BatchHost=n1\n", job, state));
  }
  // What accounts say of it; without, there are no accounts.
  void account(int job, const std::string& lines) {
    write_text(folder_ / fmt::format("accounts.{}", job), lines);
  }
  // scontrol fails with these words.
  void go_down(const std::string& words) { write_text(folder_ / "down", words); }
  void come_back() { std::filesystem::remove(folder_ / "down"); }

  // The words of each submission so far.
  std::vector<std::string> submitted() const {
    std::vector<std::string> lines;
    std::istringstream text(read_text(folder_ / "submitted"));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }

 private:
  TemporaryFolder folder_;
  std::string path_ = std::getenv("PATH");
};

}  // namespace eyeray::test
