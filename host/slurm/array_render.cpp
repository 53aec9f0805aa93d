#include "host/slurm/array_render.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "host/core/atomic_file.hpp"
#include "host/core/error.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/json_depth.hpp"
#include "host/slurm/scripts.hpp"

namespace fs = std::filesystem;

namespace eyeray::slurm {
namespace {

using Json = nlohmann::ordered_json;

// Whether a share fails on every node and at any time.
bool is_for_good(int code) {
  return code == int(ExitCode::bad_input) || code == 70;
}

// Maps a job's exit code to ours. A code that eyeray never returns (program missing, node killed) becomes
// file_io.
ExitCode told_as(int code) {
  const bool own = (code >= 1 && code <= int(ExitCode::timed_out)) || code == 70;
  return own ? ExitCode(code) : ExitCode::file_io;
}

// When a file was written last, by its folder's clock; 0 of none.
int64_t written_at(const fs::path& file) {
  std::error_code error;
  const fs::file_time_type time = fs::last_write_time(file, error);
  return error ? 0 : int64_t(time.time_since_epoch().count());
}

}  // namespace

ArrayRender::ArrayRender(ArrayRequest request) : request_(std::move(request)) {
  request_.folder = fs::absolute(request_.folder);  // its name may begin like an option
  if (request_.folder.string().find('\\') != std::string::npos)
    throw Error(ExitCode::bad_input,
                "the folder {} has a backslash in its path, where Slurm writes no output: choose another",
                request_.folder.string());
  std::error_code error;
  fs::create_directories(request_.folder, error);
  if (error)
    throw Error(ExitCode::file_io, "cannot make the folder {}: {}", request_.folder.string(),
                error.message());
  read_state();
  write_scripts();
  write_state();
}

// Slurm replaces %j and its like in the path of an output; %% is a percent sign.
std::string ArrayRender::folder_in_pattern() const {
  std::string pattern;
  for (const char c : request_.folder.string()) pattern += c == '%' ? std::string("%%") : std::string(1, c);
  return pattern;
}

std::string ArrayRender::part_name(int number) const {
  return fmt::format("{}-of-{}.eyeray", number, request_.shards);
}

fs::path ArrayRender::failure_file(int number) const {
  return file(fmt::format("{}.failed", number));
}

std::vector<int> ArrayRender::missing() const {
  // Its list, once: a question for each of thousands of parts would be the file server's load.
  std::set<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(request_.folder, error), end; !error && entry != end;
       entry.increment(error))
    names.insert(entry->path().filename().string());
  if (error == std::errc::no_such_file_or_directory)
    throw Error(ExitCode::file_io,
                "the folder {} is gone, and with it the parts: end the jobs with scancel, and begin anew",
                request_.folder.string());
  if (error)
    throw Error(ExitCode::file_io, "cannot read the folder {}: {}", request_.folder.string(),
                error.message());
  std::vector<int> numbers;
  for (int i = 1; i <= request_.shards; ++i)
    if (!names.contains(part_name(i))) numbers.push_back(i);
  return numbers;
}

ArrayRender::Failure ArrayRender::failure_of(int number) const {
  Failure failure;
  std::error_code error;
  if (!fs::exists(failure_file(number), error)) return failure;
  std::istringstream text(read_file(failure_file(number)));
  text >> failure.code >> failure.node;
  for (std::string line; std::getline(text, line);)
    if (!line.empty()) failure.words = line;  // the last
  return failure;
}

std::vector<int> ArrayRender::jobs() const {
  std::vector<int> jobs;
  for (const Array& array : arrays_) jobs.push_back(array.job);
  if (merge_ > 0) jobs.push_back(merge_);
  return jobs;
}

ArrayProgress ArrayRender::look() {
  ArrayProgress progress;
  bool active = false, cancelled = false;
  for (const Array& array : arrays_) {
    const auto states = states_of(array.job, progress.trouble);
    // Nothing is submitted twice because the scheduler is busy.
    if (!states) return progress;
    progress.trouble.clear();
    for (const JobState& state : *states) {
      active = active || state.active();
      cancelled = cancelled || state.state == "CANCELLED";
      if (state.state == "RUNNING" || state.state == "COMPLETING") progress.running += state.count();
      if (state.state != "PENDING") continue;
      progress.waiting += state.count();
      if (state.reason != "None" && progress.reason.empty()) progress.reason = state.reason;
    }
  }
  const std::vector<int> numbers = missing();
  progress.parts = request_.shards - int(numbers.size());
  if (active) return progress;

  if (!numbers.empty()) {
    if (cancelled) {
      const std::vector<int> ended = jobs();
      arrays_.clear();
      write_state();
      throw Error(ExitCode::interrupted,
                  "the array {} was cancelled with {} of {} parts there: the same command goes on from them",
                  fmt::join(ended, ", "), progress.parts, request_.shards);
    }
    if (!arrays_.empty()) judge(numbers);
    submit_shares(numbers);
    progress.waiting = numbers.size();
    return progress;
  }

  progress.merging = true;
  std::string& why = progress.trouble;
  const auto states = merge_ > 0 ? states_of(merge_, why) : std::vector<JobState>();
  if (!states) return progress;
  why.clear();
  if (std::ranges::any_of(*states, &JobState::active)) return progress;
  if (merge_ > 0 && fs::exists(file("merged"))) {
    progress.done = true;
    return progress;
  }
  if (const fs::path failed = file("merge.failed"); fs::exists(failed)) {
    std::istringstream text(read_file(failed));
    int code = 0;
    std::string line, last;
    text >> code;
    while (std::getline(text, line))
      if (!line.empty()) last = line;
    fs::remove(failed);
    throw Error(told_as(code), "the parts are all there, and the merge failed: {}", last);
  }
  if (merges_ > request_.retries)
    throw Error(ExitCode::file_io, "the merge ended {} times without a word: see {}", merges_,
                file("merge.output").string());
  submit_merge();
  ++merges_;
  write_state();
  return progress;
}

// Counts the attempts of the shares that ended without a part. Error where one of them must not be tried
// again.
void ArrayRender::judge(const std::vector<int>& numbers) {
  for (const int number : numbers) {
    // Slurm did not take its array.
    if (!checkpoints_.contains(number)) continue;
    ++retried_;
    const int64_t written = written_at(file(fmt::format("{}.work", number)));
    const Failure failure = failure_of(number);
    // Cut off, by a limit on time or a node that went, it has come further than before.
    const bool further = written != 0 && written != checkpoints_[number];
    if (failure.code == 0 || failure.code > 128) {
      attempts_[number] += !further;
    } else {
      ++attempts_[number];
    }
    if (attempts_[number] <= request_.retries && !is_for_good(failure.code)) continue;
    const std::string last = failure.words.empty() ? "it ended without a word" : failure.words;
    const int times = attempts_[number];
    arrays_.clear();
    attempts_.clear();
    write_state();
    throw Error(told_as(failure.code), "share {}/{}{}, tried {} time{}: {}", number, request_.shards,
                failure.node.empty() ? "" : " on " + failure.node, times, times == 1 ? "" : "s", last);
  }
}

void ArrayRender::submit_shares(const std::vector<int>& numbers) {
  std::error_code ignored;
  fs::remove(file("merged"), ignored);
  for (const int number : numbers) fs::remove(failure_file(number), ignored);
  // An array holds only so many: of each thousand shares, say, one.
  const int most = most_tasks();
  arrays_.clear();
  checkpoints_.clear();
  for (size_t i = 0; i < numbers.size();) {
    const int offset = numbers[i] / most * most;
    std::vector<int> tasks;
    std::map<int, int64_t> written;
    for (; i < numbers.size() && numbers[i] / most * most == offset; ++i) {
      tasks.push_back(numbers[i] - offset);
      written[numbers[i]] = written_at(file(fmt::format("{}.work", numbers[i])));
    }
    std::vector<std::string> words{"--job-name=eyeray",
                                   fmt::format("--output={}/%A_%a.output", folder_in_pattern()), "--requeue",
                                   "--signal=B:TERM@60"};
    words.insert(words.end(), request_.sbatch_words.begin(), request_.sbatch_words.end());
    words.push_back("--array=" + task_list(tasks));
    words.push_back(file("share.sh").string());
    words.push_back(std::to_string(offset));
    arrays_.push_back({submit(words), offset});
    checkpoints_.merge(written);
    // At once, so that an interruption loses no array.
    write_state();
  }
  submit_merge();
  write_state();
}

// When all arrays are done; at once when all parts are there.
void ArrayRender::submit_merge() {
  std::vector<std::string> words{"--job-name=eyeray-merge",
                                 fmt::format("--output={}/merge.output", folder_in_pattern())};
  words.insert(words.end(), request_.sbatch_words.begin(), request_.sbatch_words.end());
  if (!missing().empty()) {
    std::string after = "--dependency=afterok";
    for (const Array& array : arrays_) after += fmt::format(":{}", array.job);
    words.push_back(after);
    words.push_back("--kill-on-invalid-dep=yes");
  }
  words.push_back(file("merge.sh").string());
  merge_ = submit(words);
}

void ArrayRender::write_scripts() const {
  write_file_atomically(file("share.sh"), share_script(request_));
  write_file_atomically(file("merge.sh"), merge_script(request_));
}

void ArrayRender::read_state() {
  const fs::path state = file("render.json");
  if (!fs::exists(state)) {
    if (!fs::is_empty(request_.folder))
      throw Error(ExitCode::bad_input, "{} holds other files: --folder names one of its own",
                  request_.folder.string());
    return;
  }
  try {
    const std::string text = read_file(state);
    const Json json = Json::parse(unless_too_deep(text));
    if (json.at("identity") != request_.identity)
      throw Error(
          ExitCode::bad_input,
          "{} holds parts of another picture: the scene, an option, --shards or eyeray has changed; remove "
          "it, or name another --folder",
          request_.folder.string());
    for (const Json& array : json.at("arrays")) arrays_.push_back({array.at(0), array.at(1)});
    merge_ = json.at("merge");
    for (const Json& attempt : json.at("attempts")) attempts_[attempt.at(0)] = attempt.at(1);
    for (const Json& checkpoint : json.at("checkpoints")) checkpoints_[checkpoint.at(0)] = checkpoint.at(1);
  } catch (const Json::exception&) {
    throw Error(ExitCode::file_io, "{} is damaged: remove {}, or name another --folder", state.string(),
                request_.folder.string());
  }
}

void ArrayRender::write_state() const {
  Json arrays = Json::array(), attempts = Json::array(), checkpoints = Json::array();
  for (const Array& array : arrays_) arrays.push_back({array.job, array.offset});
  for (const auto& [number, times] : attempts_) attempts.push_back({number, times});
  for (const auto& [number, time] : checkpoints_) checkpoints.push_back({number, time});
  const Json state{{"identity", request_.identity},
                   {"arrays", arrays},
                   {"merge", merge_},
                   {"attempts", attempts},
                   {"checkpoints", checkpoints}};
  write_file_atomically(file("render.json"), json_text(state) + "\n");
}

}  // namespace eyeray::slurm
