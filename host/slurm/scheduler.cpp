#include "host/slurm/scheduler.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>
#include <string_view>

#include "host/core/error.hpp"
#include "host/core/process.hpp"
#include "host/render/tiling.hpp"

namespace eyeray::slurm {
namespace {

// A scheduler that is busy answers late.
constexpr double patience = 120;

// What a command of Slurm answered; Error (file_io) where there is no such command.
ProcessResult ask(const std::vector<std::string>& words) {
  try {
    return run_process(words, {}, patience);
  } catch (const Error&) {
    throw Error(ExitCode::file_io,
                "there is no {} here: is this a machine that Slurm's jobs are submitted from?", words[0]);
  }
}

std::string first_line(std::string text) {
  text.resize(std::min(text.find('\n'), text.size()));
  return text;
}

std::optional<int> parse_number(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || number < 0) return std::nullopt;
  return number;
}

// Slurm has forgotten a job a few minutes after its end, unless it keeps accounts: lines "17_3|TIMEOUT|vm".
std::vector<JobState> accounted_states_of(int job) {
  const ProcessResult answer =
      ask({"sacct", "-n", "-P", "-X", "-j", std::to_string(job), "-o", "JobID,State,NodeList"});
  std::vector<JobState> states;
  if (answer.code != 0) return states;
  std::istringstream lines(answer.out);
  for (std::string line; std::getline(lines, line);) {
    std::array<std::string, 3> fields;
    std::istringstream columns(line);
    for (std::string& field : fields) std::getline(columns, field, '|');
    JobState state;
    if (const size_t at = fields[0].find('_'); at != std::string::npos) {
      std::string tasks = fields[0].substr(at + 1);
      std::erase_if(tasks, [](char c) { return c == '[' || c == ']'; });
      state.tasks = parse_task_list(tasks).value_or(std::vector<int>());
    }
    state.state = fields[1].substr(0, fields[1].find(' '));  // "CANCELLED by 1000"
    state.node = fields[2];
    states.push_back(std::move(state));
  }
  return states;
}

}  // namespace

bool JobState::active() const {
  constexpr std::string_view states[] = {"PENDING",  "RUNNING",      "COMPLETING", "CONFIGURING", "SUSPENDED",
                                         "REQUEUED", "REQUEUE_HOLD", "RESIZING",   "STAGE_OUT",   "STOPPED"};
  return std::ranges::find(states, state) != std::end(states);
}

std::string task_list(const std::vector<int>& tasks) {
  std::vector<std::string> ranges;
  for (size_t i = 0; i < tasks.size();) {
    size_t last = i;
    while (last + 1 < tasks.size() && tasks[last + 1] == tasks[last] + 1) ++last;
    ranges.push_back(last == i ? std::to_string(tasks[i]) : fmt::format("{}-{}", tasks[i], tasks[last]));
    i = last + 1;
  }
  return fmt::format("{}", fmt::join(ranges, ","));
}

std::optional<std::vector<int>> parse_task_list(const std::string& text) {
  std::vector<int> tasks;
  std::istringstream ranges(text.substr(0, text.find('%')));
  for (std::string range; std::getline(ranges, range, ',');) {
    const size_t dash = range.find('-');
    const std::optional<int> first = parse_number(range.substr(0, dash));
    const std::optional<int> last = dash == std::string::npos ? first : parse_number(range.substr(dash + 1));
    if (!first || !last || *last < *first || *last - *first > render::most_shards) return std::nullopt;
    for (int task = *first; task <= *last; ++task) tasks.push_back(task);
  }
  if (tasks.empty()) return std::nullopt;
  return tasks;
}

std::vector<JobState> parse_jobs(const std::string& text) {
  std::vector<JobState> jobs;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("JobId=")) continue;
    JobState job;
    std::istringstream words(line);
    for (std::string word; words >> word;) {
      const auto value_of = [&](std::string_view key) {
        return word.starts_with(key) ? std::optional(word.substr(key.size())) : std::nullopt;
      };
      if (const auto tasks = value_of("ArrayTaskId="))
        job.tasks = parse_task_list(*tasks).value_or(std::vector<int>());
      if (const auto state = value_of("JobState=")) job.state = *state;
      if (const auto reason = value_of("Reason=")) job.reason = *reason;
      if (const auto node = value_of("BatchHost=")) job.node = *node;
    }
    jobs.push_back(std::move(job));
  }
  return jobs;
}

int submit(const std::vector<std::string>& words) {
  std::vector<std::string> command{"sbatch", "--parsable"};
  command.insert(command.end(), words.begin(), words.end());
  const ProcessResult answer = ask(command);
  if (answer.code != 0)
    throw Error(
        ExitCode::file_io, "Slurm takes no job: {}",
        answer.code < 0 ? fmt::format("sbatch has not answered for {} s", patience) : first_line(answer.err));
  // "17", or "17;cluster".
  const std::string number = first_line(answer.out);
  const std::optional<int> job = parse_number(number.substr(0, number.find(';')));
  if (!job) throw Error(ExitCode::file_io, "sbatch answers '{}', which is no job's number", number);
  return *job;
}

std::optional<std::vector<JobState>> states_of(int job, std::string& why) {
  const ProcessResult answer = ask({"scontrol", "--oneliner", "show", "job", std::to_string(job)});
  if (answer.code == 0) return parse_jobs(answer.out);
  why = first_line(answer.err.empty() ? answer.out : answer.err);
  if (answer.code < 0) why = fmt::format("scontrol has not answered for {} s", patience);
  if (why.empty()) why = "scontrol failed without a word";
  if (why.find("Invalid job id") == std::string::npos) return std::nullopt;
  return accounted_states_of(job);
}

int most_tasks() {
  constexpr int usual = 1001;
  const ProcessResult answer = ask({"scontrol", "show", "config"});
  std::istringstream lines(answer.out);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("MaxArraySize")) continue;
    const std::optional<int> size = parse_number(line.substr(std::min(line.size(), line.rfind(' ') + 1)));
    return size && *size > 0 ? *size : usual;
  }
  return usual;
}

}  // namespace eyeray::slurm
