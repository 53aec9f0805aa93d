// Slurm's own commands, and what they say of jobs. Nothing else of Slurm is needed.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace eyeray::slurm {

// Jobs of one array, or one job, that are in the same state.
struct JobState {
  std::vector<int> tasks;  // of the array, in order; empty of a job that is none
  std::string state;       // PENDING, RUNNING, COMPLETED, FAILED, CANCELLED, TIMEOUT, NODE_FAIL, …
  std::string reason;      // why it waits, as Slurm says it
  std::string node;

  // Whether it is going to run, runs, or ends just now.
  bool active() const;
  // A job that is no array counts as one task.
  size_t count() const { return tasks.empty() ? 1 : tasks.size(); }
};

// "3,7-9", as sbatch takes and scontrol prints lists of tasks; a "%4" behind it, how many may run at once, is
// passed over. Both ways; nothing for another text.
std::string task_list(const std::vector<int>& tasks);
std::optional<std::vector<int>> parse_task_list(const std::string& text);

// What `scontrol --oneliner show job` prints.
std::vector<JobState> parse_jobs(const std::string& text);

// Submits a script with these words of sbatch. Its job's number. Error (file_io) when there is no sbatch, or
// with its own words when it refuses.
int submit(const std::vector<std::string>& words);

// The states of a job, finished ones as long as Slurm knows them, by its accounting where it has any; empty
// when nobody does. Nothing when the scheduler does not answer, `why` then says what it said.
std::optional<std::vector<JobState>> states_of(int job, std::string& why);

// How many tasks an array may have: Slurm's MaxArraySize, 1001 where it does not say.
int most_tasks();

}  // namespace eyeray::slurm
