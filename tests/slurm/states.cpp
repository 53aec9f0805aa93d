// Tests of the jobs that are submitted, for all states of Slurm and of the folder.
#include <fmt/format.h>

#include "fake_slurm.hpp"
#include "host/core/error.hpp"
#include "host/slurm/array.hpp"
#include "tests/cli/scene.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::slurm;
using namespace eyeray::engine::test;

namespace {

// A picture in shares under a fake Slurm, whose answers each test case chooses.
struct Farm {
  FakeSlurm slurm;
  SceneFolder folder;
  Array array;

  explicit Farm(int shards = 3) {
    array.program = eyeray_binary();
    array.render_words = {folder.scene(), "--backend", "twin", "-s", "32x24"};
    array.last_words = {"-o", folder / "whole.pfm"};
    array.files = {folder / "whole.pfm"};
    array.folder = folder / "work";
    array.shards = shards;
    array.contents = "1234";
  }

  std::string file(const std::string& name) const { return array.folder / name; }
  // The state as a new command finds it, which knows only the folder's contents.
  ArrayState state() const {
    Array now = array;
    prepare(now);
    return state_of(now);
  }
  std::vector<std::string> submit() const {
    Array now = array;
    prepare(now);
    return slurm::submit(now, state_of(now));
  }
  void finish(int share) const {
    const ProcessResult result =
        run_process({"sh", file("share.sh"), "0"}, {{"SLURM_ARRAY_TASK_ID", std::to_string(share)}}, 600);
    CAPTURE(result.err);
    REQUIRE(result.code == 0);
  }
  // The message of the error with which the command ends.
  std::string failure(ExitCode code) const {
    try {
      submit();
    } catch (const Error& error) {
      CHECK(error.code() == code);
      return error.what();
    }
    return "";
  }
};

bool contains(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("only missing shares are submitted, followed by the merge, until all are there") {
  Farm farm;
  CHECK(farm.submit() == std::vector<std::string>{"1", "2"});
  prepare(farm.array);
  const std::string name = farm.array.job_name;
  CHECK(contains(farm.slurm.submitted()[0], "--job-name=" + name + " --array=1,2,3 "));
  CHECK(contains(farm.slurm.submitted()[1], "--job-name=" + name + " --dependency=afterok:1 "));
  farm.slurm.write("queue", "1_[1-3] PENDING 0:00 (Priority)\n2 PENDING 0:00 (Dependency)\n");
  CHECK(farm.state().queue.size() == 2);
  farm.slurm.write("queue", "");

  for (const int share : {1, 3}) farm.finish(share);
  CHECK(farm.state().missing == std::vector<int>{2});
  CHECK(farm.state().output.empty());
  write_text(farm.file("2.output"), "eyeray: error: no Vulkan here\n");
  CHECK(farm.state().output == farm.file("2.output"));
  CHECK(farm.state().failures.empty());
  farm.slurm.write("accounts", "1_2 FAILED 3:0 n7\n");
  CHECK(farm.state().failures == std::vector<std::string>{"1_2 FAILED 3:0 n7"});
  CHECK(contains(farm.slurm.read("requested"), "--name=" + name + " "));
  farm.submit();
  CHECK(contains(farm.slurm.submitted()[2], "--array=2 "));
  CHECK_FALSE(std::filesystem::exists(farm.file("2.output")));

  farm.finish(2);
  CHECK(farm.state().missing.empty());
  CHECK_FALSE(farm.state().done);
  // The merge ended too early: it is submitted alone.
  write_text(farm.file("merge.output"), "eyeray: error: No space left on device\n");
  CHECK(farm.state().output == farm.file("merge.output"));
  CHECK(farm.submit() == std::vector<std::string>{"5"});
  CHECK_FALSE(contains(farm.slurm.submitted()[4], "--dependency"));
  REQUIRE(run_process({"sh", farm.file("merge.sh")}, {}, 600).code == 0);
  CHECK(farm.state().done);

  // A damaged part is rendered again, and then the parts are merged again.
  std::string part = read_text(farm.file("2-of-3.eyeray"));
  part[part.size() / 2] = char(part[part.size() / 2] ^ 1);
  write_text(farm.file("2-of-3.eyeray"), part);
  const ArrayState damaged = farm.state();
  CHECK(damaged.missing == std::vector<int>{2});
  REQUIRE(damaged.faults.size() == 1);
  CHECK(contains(damaged.faults[0], "2-of-3.eyeray: it is damaged: its checksum is wrong"));
  farm.submit();
  CHECK_FALSE(std::filesystem::exists(farm.file("2-of-3.eyeray")));
  CHECK_FALSE(std::filesystem::exists(farm.file("merged")));
}

TEST_CASE("if Slurm is missing, refuses or does not answer, its own message is the error") {
  Farm farm;
  farm.slurm.write("most", "0");
  CHECK(farm.failure(ExitCode::file_io) == "Slurm's sbatch fails: sbatch: error: no more");
  farm.slurm.add("squeue", "echo 'slurm_load_jobs error: Unable to contact slurm controller' >&2; exit 1\n");
  CHECK(farm.failure(ExitCode::file_io) ==
        "Slurm's squeue fails: slurm_load_jobs error: Unable to contact slurm controller");
  CHECK(farm.slurm.submitted().size() == 1);
  ::setenv("PATH", "/nowhere", 1);
  CHECK(contains(farm.failure(ExitCode::file_io), "squeue is not installed here"));
}

TEST_CASE("ten thousand shares become arrays of the largest size that Slurm takes, each share once") {
  const Farm farm(10000);
  farm.submit();
  const std::vector<std::string> submitted = farm.slurm.submitted();
  REQUIRE(submitted.size() == 12);
  CHECK(contains(submitted[0], "/%a.output "));
  CHECK(contains(submitted[0], "--array=1,2,3,"));
  CHECK(contains(submitted[0], ",999 "));
  CHECK(submitted[0].ends_with("share.sh 0"));
  CHECK(contains(submitted[9], "/9%3a.output "));
  CHECK(contains(submitted[9], "--array=0,1,2,"));
  CHECK(submitted[10].ends_with("--array=0 " + farm.file("share.sh") + " 10000"));
  CHECK(contains(submitted[11], "--dependency=afterok:1:2:3:4:5:6:7:8:9:10:11 "));
}

TEST_CASE("a folder with other files or another picture, or one that cannot be made, is refused") {
  Farm farm;
  farm.submit();
  write_text(farm.file("share.sh"), "#!/bin/sh\n# edited\n");
  farm.submit();
  CHECK(contains(read_text(farm.file("share.sh")), "# edited"));
  farm.array.folder = farm.folder / "." / farm.array.folder.filename() / "";  // the same, written otherwise
  CHECK(farm.state().missing.size() == 3);
  farm.array.contents = "5678";
  CHECK(contains(farm.failure(ExitCode::bad_input), "contains another picture"));
  farm.array.folder = farm.folder.path();
  CHECK(contains(farm.failure(ExitCode::bad_input), "contains other files"));
  farm.array.folder = farm.folder / "scene.toml/work";
  CHECK(contains(farm.failure(ExitCode::file_io), "cannot make the folder"));
}
