// Programs that give the answers that a test chooses. Real programs take minutes for such answers, or give
// them only if something breaks.
#pragma once

#include <cstdlib>

#include "tests/support/process.hpp"

namespace eyeray::engine::test {

// Shell scripts that are first in this process's PATH as long as the object lives; $folder has their files.
class FakePrograms {
 public:
  FakePrograms() { ::setenv("PATH", (folder_.path().string() + ":" + path_).c_str(), 1); }
  ~FakePrograms() { ::setenv("PATH", path_.c_str(), 1); }

  void add(const std::string& name, const std::string& script) const {
    write(name, "#!/bin/sh\nfolder=" + folder_.path().string() + "\n" + script);
    std::filesystem::permissions(folder_ / name, std::filesystem::perms::owner_all);
  }
  void write(const std::string& name, const std::string& text) const { write_text(folder_ / name, text); }
  std::string read(const std::string& name) const { return read_text(folder_ / name); }

 private:
  TemporaryFolder folder_;
  std::string path_ = std::getenv("PATH");
};

// squeue and sacct print the files `queue` and `accounts`. sbatch takes at most `most` jobs.
struct FakeSlurm : FakePrograms {
  FakeSlurm() {
    add("sbatch",
        "echo \"$@\" >>\"$folder/submitted\"\n"
        "job=$(wc -l <\"$folder/submitted\")\n"
        "[ \"$job\" -gt \"$(cat \"$folder/most\")\" ] && { echo 'sbatch: error: no more' >&2; exit 1; }\n"
        "echo \"$job;cluster\"\n");
    add("squeue", "cat \"$folder/queue\"\n");
    add("sacct", "cat \"$folder/accounts\" && echo \"$@\" >\"$folder/requested\"\n");
    add("scontrol", "echo \"$@\" >\"$folder/controlled\"\n");
    write("most", "1000");
    write("queue", "");
  }
  // The words of each submission so far.
  std::vector<std::string> submitted() const {
    std::vector<std::string> lines;
    std::istringstream text(read("submitted"));
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }
};

}  // namespace eyeray::engine::test
