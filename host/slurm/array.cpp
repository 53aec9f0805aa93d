#include "host/slurm/array.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <set>
#include <sstream>

#include "host/core/atomic_file.hpp"
#include "host/core/content_hash.hpp"
#include "host/core/error.hpp"
#include "host/core/process.hpp"
#include "host/shards/part_set.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::slurm {
namespace {

// Seconds to wait for a command of Slurm, since a busy scheduler answers late.
constexpr double patience = 120;
// The most tasks of one array by Slurm's default (MaxArraySize).
constexpr int most_tasks = 1000;

// The output of a Slurm command, as lines. Error (file_io) with its message if it fails.
std::vector<std::string> ask(const std::vector<std::string>& words) {
  ProcessResult answer;
  try {
    answer = run_process(words, {}, patience);
  } catch (const Error&) {
    throw Error(ExitCode::file_io,
                "{} is not installed here: run this on a machine from which Slurm jobs are submitted",
                words[0]);
  }
  if (answer.code != 0)
    throw Error(ExitCode::file_io, "Slurm's {} {}", words[0],
                answer.code < 0 ? fmt::format("has not answered for {} s", patience)
                                : "fails: " + answer.err.substr(0, answer.err.find('\n')));
  std::vector<std::string> lines;
  std::istringstream text(answer.out);
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

// The failures of the jobs, from Slurm's accounts. Empty, too, if a site keeps no accounts.
std::vector<std::string> failures_of(const std::string& job_name) try {
  return ask({"sacct", "--name=" + job_name, "--allocations", "--noheader", "--parsable2",
              "--delimiter= ", "--starttime=now-7days", "--state=BF,CA,DL,F,NF,OOM,TO",
              "--format=JobID,State,ExitCode,NodeList"});
} catch (const Error&) {
  return {};
}

bool is_there(const fs::path& file) {
  return fs::exists(file);
}

std::string output_of(int share) {
  return fmt::format("{}.output", share);
}

void find_missing_parts(const Array& array, ArrayState& state) {
  std::vector<fs::path> files;
  for (int share = 1; share <= array.shards; ++share) files.push_back(array.part(share));
  std::erase_if(files, std::not_fn(is_there));
  const shards::PartSet set(files);
  std::set<int> whole;
  for (const shards::PartReader& part : set.parts()) whole.insert(part.header().shard.index + 1);
  for (int share = 1; share <= array.shards; ++share)
    if (!whole.contains(share)) state.missing.push_back(share);
  for (const auto* faults : {&set.faults().damaged, &set.faults().foreign, &set.faults().doubled})
    state.faults.insert(state.faults.end(), faults->begin(), faults->end());
}

// Submits a job, and returns its number.
std::string submit(const Array& array, const std::string& output, std::vector<std::string> last) {
  // In --output a percent sign begins one of Slurm's fields.
  std::string pattern;
  for (const char c : array.folder.string()) pattern += c == '%' ? std::string("%%") : std::string(1, c);
  std::vector<std::string> words{"sbatch", "--parsable",
                                 fmt::format("--output={}/{}.output", pattern, output)};
  words.insert(words.end(), array.sbatch_words.begin(), array.sbatch_words.end());
  words.push_back("--job-name=" + array.job_name);
  words.insert(words.end(), last.begin(), last.end());
  const std::vector<std::string> answer = ask(words);
  // The answer is "17", or "17;cluster".
  return answer.empty() ? "" : answer[0].substr(0, answer[0].find(';'));
}

}  // namespace

void prepare(Array& array) {
  // Make the path absolute, so that a folder has one name, and a relative name may begin like an option.
  array.folder = (fs::absolute(array.folder) / "").lexically_normal().parent_path();
  const std::string folder = array.folder.string();
  if (folder.find('\\') != std::string::npos)
    throw Error(ExitCode::bad_input,
                "the folder {} has a backslash in its path, where Slurm cannot write output: choose another",
                folder);
  std::error_code error;
  fs::create_directories(array.folder, error);
  if (error) throw Error(ExitCode::file_io, "cannot make the folder {}: {}", folder, error.message());
  array.job_name = "eyeray-" + ContentHash().add(folder).hex().substr(0, 12);

  const std::string share = share_script(array), merge = merge_script(array);
  const std::string identity = ContentHash().add(array.contents).add(share).add(merge).hex();
  if (!is_there(array.file("identity"))) {
    if (!fs::is_empty(array.folder))
      throw Error(ExitCode::bad_input,
                  "{} contains other files: name a folder for this picture alone with --folder", folder);
    write_file_atomically(array.file("identity"), identity);
  } else if (read_file(array.file("identity")) != identity) {
    throw Error(ExitCode::bad_input,
                "{} contains another picture: the scene, an option, an output, --shards or eyeray has "
                "changed; remove it, or name another --folder",
                folder);
  }
  if (!is_there(array.file("share.sh"))) write_file_atomically(array.file("share.sh"), share);
  if (!is_there(array.file("merge.sh")) && !array.last_words.empty())
    write_file_atomically(array.file("merge.sh"), merge);
}

ArrayState state_of(const Array& array) {
  ArrayState state;
  // Query the queue first, so that the files of a job that ends meanwhile are seen.
  state.queue = ask({"squeue", "--name=" + array.job_name, "--noheader", "--format=%i %T %M %R"});
  if (array.is_picture()) find_missing_parts(array, state);
  for (size_t i = 0; i < array.frames_of_shares.size(); ++i)
    if (!std::ranges::all_of(array.frames_of_shares[i], is_there)) state.missing.push_back(int(i) + 1);
  const bool merged = array.last_words.empty() || is_there(array.file("merged"));
  state.done =
      state.queue.empty() && state.missing.empty() && merged && std::ranges::all_of(array.files, is_there);
  if (state.done || !state.queue.empty()) return state;

  std::vector<fs::path> outputs;
  for (const int share : state.missing) outputs.push_back(array.file(output_of(share)));
  outputs.push_back(array.file("merge.output"));
  const auto first = std::ranges::find_if(outputs, is_there);
  if (first == outputs.end()) return state;
  state.output = *first;
  state.failures = failures_of(array.job_name);
  return state;
}

std::vector<std::string> submit(const Array& array, const ArrayState& state) {
  for (const char* name : {"merged", "merge.output"}) fs::remove(array.file(name));
  std::vector<std::string> jobs;
  for (auto next = state.missing.begin(); next != state.missing.end();) {
    const int offset = *next / most_tasks * most_tasks;
    std::vector<int> tasks;
    for (; next != state.missing.end() && *next < offset + most_tasks; ++next) {
      tasks.push_back(*next - offset);
      fs::remove(array.part(*next));
      fs::remove(array.file(output_of(*next)));
    }
    // Outputs bear the number of the share: "7.output", "2007.output".
    jobs.push_back(submit(
        array, offset == 0 ? "%a" : fmt::format("{}%3a", offset / most_tasks),
        {fmt::format("--array={}", fmt::join(tasks, ",")), array.file("share.sh"), std::to_string(offset)}));
  }
  if (array.last_words.empty()) return jobs;
  std::vector<std::string> words{array.file("merge.sh")};
  if (!jobs.empty())
    words = {fmt::format("--dependency=afterok:{}", fmt::join(jobs, ":")), "--kill-on-invalid-dep=yes",
             words[0]};
  jobs.push_back(submit(array, "merge", words));
  return jobs;
}

}  // namespace eyeray::engine::slurm
