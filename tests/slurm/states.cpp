// What is done about each end of a job, whatever Slurm or the folder says.
#include "fake_slurm.hpp"
#include "host/core/error.hpp"
#include "host/slurm/array_render.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::slurm;
using namespace eyeray::test;

namespace {

// An array of shares under a Slurm that says what it is told to. Its first jobs are 1 and, the merge, 2.
struct Farm {
  FakeSlurm slurm;
  TemporaryFolder outer;
  ArrayRequest request;

  explicit Farm(int shards = 3, int retries = 1) {
    request.program = "eyeray";
    request.scene = "a.toml";
    request.folder = outer / "work";
    request.shards = shards;
    request.retries = retries;
    request.identity = "1234";
  }

  // As each command does: it knows what the folder says.
  ArrayProgress look() const { return ArrayRender(request).look(); }
  std::string file(const std::string& name) const { return request.folder / name; }
  void finish(int share) const {
    write_text(file(fmt::format("{}-of-{}.eyeray", share, request.shards)), "");
  }
  void fail(int share, int code, const std::string& words) const {
    write_text(file(fmt::format("{}.failed", share)), fmt::format("{} n7\n{}\n", code, words));
  }
  // A checkpoint, written `hours` from now by the folder's clock.
  void checkpoint(int share, int hours) const {
    const std::string work = file(fmt::format("{}.work", share));
    write_text(work, "");
    std::filesystem::last_write_time(
        work, std::filesystem::file_time_type::clock::now() + std::chrono::hours(hours));
  }
  // The code and the words that it ends with.
  std::pair<int, std::string> failure() const {
    try {
      look();
    } catch (const Error& error) {
      return {int(error.code()), error.what()};
    }
    return {0, ""};
  }
  size_t submissions() const { return slurm.submitted().size(); }
};

bool contains(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("shares are submitted once, merged once, and done") {
  Farm farm;
  CHECK(farm.look().waiting == 3);
  REQUIRE(farm.submissions() == 2);
  CHECK(contains(farm.slurm.submitted()[0], "--array=1-3 "));
  CHECK(contains(farm.slurm.submitted()[1], "--dependency=afterok:1 "));
  // Preempted, a job waits under its number: it is Slurm's to begin again.
  for (const char* state : {"PENDING", "RUNNING", "COMPLETING", "REQUEUED", "SUSPENDED"}) {
    farm.slurm.set(1, {{"1-2", "COMPLETED"}, {"3", state}});
    farm.look();
    CHECK(farm.submissions() == 2);
  }
  farm.slurm.set(1, {{"1-3", "COMPLETED"}});
  for (const int share : {1, 2, 3}) farm.finish(share);
  farm.slurm.set(2, "RUNNING");
  CHECK(farm.look().merging);
  CHECK_FALSE(farm.look().done);
  farm.slurm.set(2, "COMPLETED");
  write_text(farm.file("merged"), "");
  CHECK(farm.look().done);
  CHECK(farm.submissions() == 2);

  // A part that is no longer there is rendered again, and then they are merged again.
  std::filesystem::remove(farm.file("2-of-3.eyeray"));
  CHECK_FALSE(farm.look().done);
  CHECK(farm.submissions() == 4);
  farm.slurm.set(3, {{"2", "COMPLETED"}});
  farm.finish(2);
  farm.slurm.set(4, "PENDING");
  CHECK_FALSE(farm.look().done);
  farm.slurm.set(4, "NODE_FAIL");
  CHECK_FALSE(farm.look().done);
  CHECK(farm.submissions() == 5);
}

TEST_CASE("only what is missing is submitted again, until it has been tried often enough") {
  Farm farm;
  farm.look();
  farm.slurm.set(1, {{"1,3", "COMPLETED"}, {"2", "FAILED"}});
  farm.finish(1);
  farm.finish(3);
  farm.fail(2, 3, "eyeray: error: no Vulkan here");
  CHECK(farm.look().parts == 2);
  REQUIRE(farm.submissions() == 4);
  CHECK(contains(farm.slurm.submitted()[2], "--array=2 "));
  CHECK_FALSE(std::filesystem::exists(farm.file("2.failed")));

  farm.slurm.set(3, {{"2", "FAILED"}});
  farm.fail(2, 3, "eyeray: error: no Vulkan here");
  CHECK(farm.failure() ==
        std::pair(3, std::string("share 2/3 on n7, tried 2 times: eyeray: error: no Vulkan here")));
  CHECK(farm.submissions() == 4);
}

TEST_CASE("what no other node mends is not tried twice, and a foreign code is none of eyeray's") {
  for (const auto& [code, told] : {std::pair(2, 2), std::pair(70, 70)}) {
    Farm farm(1, 9);
    farm.look();
    farm.slurm.set(1, {{"1", "FAILED"}});
    farm.fail(1, code, "why");
    CHECK(farm.failure() == std::pair(told, std::string("share 1/1 on n7, tried 1 time: why")));
    CHECK(farm.submissions() == 2);
  }
  Farm farm(1, 0);
  farm.look();
  farm.slurm.set(1, {{"1", "FAILED"}});
  farm.fail(1, 127, "eyeray: not found");
  CHECK(farm.failure().first == int(ExitCode::file_io));
}

TEST_CASE("cut off, a share counts as failed only where its checkpoint has come no further") {
  Farm farm(1, 1);
  farm.look();
  int job = 1;
  // Clocks apart: what counts is that it is another time, not which is later.
  for (const int hours : {-5, 100, 0, -90}) {
    farm.slurm.set(job, {{"1", hours == 0 ? "NODE_FAIL" : "TIMEOUT"}});
    farm.checkpoint(1, hours);
    if (hours == 100) farm.fail(1, 143, "eyeray: interrupted");
    CHECK(farm.failure() == std::pair(0, std::string()));
    job += 2;
    CHECK(farm.submissions() == size_t(job + 1));
  }
  // The same again twice: one retry, then no more.
  for (const int code : {0, 4}) {
    farm.slurm.set(job, {{"1", "TIMEOUT"}});
    CHECK(farm.failure().first == code);
    job += 2;
  }
}

TEST_CASE("a cancelled array is told, and submitted when it is asked for again") {
  Farm farm;
  farm.look();
  farm.slurm.set(1, {{"1", "COMPLETED"}, {"2-3", "CANCELLED"}});
  farm.finish(1);
  const auto [code, words] = farm.failure();
  CHECK(code == 130);
  CHECK(words == "the array 1, 2 was cancelled with 1 of 3 parts there: the same command goes on from them");
  CHECK(farm.submissions() == 2);
  farm.look();
  REQUIRE(farm.submissions() == 4);
  CHECK(contains(farm.slurm.submitted()[2], "--array=2-3 "));
}

TEST_CASE("of what Slurm has forgotten accounts tell, and where there are none the folder does") {
  Farm farm;
  farm.look();
  farm.slurm.account(1, "1_1|COMPLETED|n1\n1_[2-3]|CANCELLED by 1000|None assigned\n");
  farm.finish(1);
  CHECK(farm.failure().first == 130);

  Farm without;
  without.look();
  without.finish(1);
  without.fail(2, 4, "a disk is full");
  CHECK(without.failure().first == 0);
  REQUIRE(without.submissions() == 4);
  CHECK(contains(without.slurm.submitted()[2], "--array=2-3 "));
  without.fail(3, 4, "a disk is full");
  CHECK(contains(without.failure().second, "share 2/3, tried 2 times: it ended without a word"));
}

TEST_CASE("while Slurm does not answer nothing is submitted") {
  Farm farm;
  farm.look();
  farm.slurm.go_down("slurm_load_jobs error: Unable to contact slurm controller (connect failure)\n");
  CHECK(farm.look().trouble == "slurm_load_jobs error: Unable to contact slurm controller (connect failure)");
  farm.slurm.go_down("");
  CHECK(farm.look().trouble == "scontrol failed without a word");
  CHECK(farm.submissions() == 2);
  farm.slurm.come_back();
  farm.slurm.set(1, {{"1-3", "RUNNING"}});
  CHECK(farm.look().trouble == "");
}

TEST_CASE("ten thousand shares are arrays of as many as Slurm takes, and each is theirs once") {
  Farm farm(10000);
  farm.look();
  REQUIRE(farm.submissions() == 11);
  CHECK(contains(farm.slurm.submitted()[0], "--array=1-1000 "));
  CHECK(contains(farm.slurm.submitted()[1], "--array=0-1000 "));
  CHECK(farm.slurm.submitted()[1].ends_with("share.sh 1001"));
  CHECK(contains(farm.slurm.submitted()[9], "--array=0-991 "));
  CHECK(farm.slurm.submitted()[9].ends_with("share.sh 9009"));
  CHECK(contains(farm.slurm.submitted()[10], "--dependency=afterok:1:2:3:4:5:6:7:8:9:10 "));
}

TEST_CASE("shares whose array was not taken have not failed") {
  Farm farm(2500, 0);
  farm.slurm.allow(1);
  CHECK(contains(farm.failure().second, "Slurm takes no job: sbatch: error: no more"));
  farm.slurm.allow(1000);
  // The one that was is waited for.
  farm.slurm.set(1, {{"1-1000", "RUNNING"}});
  CHECK(farm.look().running == 1000);
  CHECK(farm.submissions() == 2);
  farm.slurm.set(1, {{"1-1000", "COMPLETED"}});
  for (int share = 1; share <= 1000; ++share) farm.finish(share);
  CHECK(farm.failure() == std::pair(0, std::string()));
  CHECK(contains(farm.slurm.submitted()[2], "--array=0-1000 "));
}

TEST_CASE("a merge that fails is told, and one that ends without a word is tried again") {
  Farm farm(1, 1);
  farm.look();
  farm.slurm.set(1, {{"1", "COMPLETED"}});
  farm.finish(1);
  farm.slurm.set(2, "FAILED");
  write_text(farm.file("merge.failed"), "4 n7\neyeray: error: cannot write x.png: No space left on device\n");
  CHECK(farm.failure() ==
        std::pair(4, std::string("the parts are all there, and the merge failed: eyeray: error: cannot write "
                                 "x.png: No space left on device")));
  ArrayRender render(farm.request);
  for (const int job : {3, 4}) {
    render.look();
    CHECK(farm.submissions() == size_t(job));
    CHECK_FALSE(contains(farm.slurm.submitted().back(), "--dependency"));
    farm.slurm.set(job, "NODE_FAIL");
  }
  CHECK_THROWS_AS(render.look(), Error);
  CHECK(farm.submissions() == 4);
}

TEST_CASE("a folder that is gone or holds something else is told") {
  Farm farm;
  farm.look();
  farm.slurm.set(1, {{"1-3", "RUNNING"}});
  ArrayRender render(farm.request);
  std::filesystem::rename(farm.request.folder, farm.outer / "elsewhere");
  CHECK_THROWS_WITH_AS(render.look(),
                       ("the folder " + farm.file("").substr(0, farm.file("").size() - 1) +
                        " is gone, and with it the parts: end the jobs with scancel, and begin anew")
                           .c_str(),
                       Error);
  std::filesystem::create_directory(farm.request.folder);
  write_text(farm.file("mine"), "");
  CHECK(contains(farm.failure().second, "holds other files"));
  write_text(farm.file("render.json"), "{");
  CHECK(contains(farm.failure().second, "render.json is damaged"));
  farm.request.identity = "5678";
  write_text(farm.file("render.json"), R"({"identity":"1234"})");
  CHECK(contains(farm.failure().second, "holds parts of another picture"));
}
