// The answers of Slurm's commands, parsed.
#include "host/slurm/scheduler.hpp"

#include "host/slurm/scripts.hpp"
#include "tests/support/process.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::slurm;

TEST_CASE("lists of tasks are written and read as Slurm does") {
  CHECK(task_list({3}) == "3");
  CHECK(task_list({1, 2, 3, 5, 8, 9}) == "1-3,5,8-9");
  CHECK(parse_task_list("1-3,5,8-9%4") == std::vector<int>{1, 2, 3, 5, 8, 9});
  for (const char* text : {"", "a", "3-", "4-2", "1-99999999", "N/A", "-1"})
    CHECK_FALSE(parse_task_list(text));
}

TEST_CASE("jobs are read as scontrol prints them") {
  // By slurm 22.05.8.
  const std::vector<JobState> jobs = parse_jobs(
      "JobId=1 ArrayJobId=1 ArrayTaskId=4-6%2 JobName=a b JobState=PENDING Reason=Resources "
      "Dependency=(null)\n"
      "JobId=3 ArrayJobId=1 ArrayTaskId=2 JobName=a JobState=RUNNING Reason=None NodeList=n1 BatchHost=n1\n"
      "JobId=2 ArrayJobId=1 ArrayTaskId=1 JobName=a JobState=COMPLETED Reason=None ExitCode=0:0 "
      "BatchHost=n2\n");
  REQUIRE(jobs.size() == 3);
  CHECK(jobs[0].tasks == std::vector<int>{4, 5, 6});
  CHECK(jobs[0].count() == 3);
  CHECK(jobs[0].reason == "Resources");
  CHECK(jobs[0].active());
  CHECK(jobs[1].active());
  CHECK(jobs[1].node == "n1");
  CHECK_FALSE(jobs[2].active());
  CHECK(parse_jobs("slurm_load_jobs error\n").empty());
}
