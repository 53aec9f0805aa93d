#include "host/slurm/scripts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/core/escaped_text.hpp"

namespace eyeray::slurm {
namespace {

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += " " + shell_word(word);
  return text;
}

// The beginning of both scripts. SIGTERM ends a job, which passes it on to eyeray, which saves its
// checkpoint: the shell waits for it, and again, since `wait` ends with the signal.
std::string head(const ArrayRequest& request) {
  return fmt::format(
      "#!/bin/sh\n"
      "# Written by eyeray slurm.\n"
      "set -u\n"
      "cd {} || exit 4\n"
      "folder={}\n"
      "run() {{\n"
      "  \"$@\" 2>\"$log\" &\n"
      "  child=$!\n"
      "  trap 'kill -TERM $child' TERM\n"
      "  wait $child\n"
      "  code=$?\n"
      "  while kill -0 $child 2>/dev/null; do\n"
      "    wait $child\n"
      "    code=$?\n"
      "  done\n"
      "  trap - TERM\n"
      "}}\n",
      shell_word(std::filesystem::current_path().string()), shell_word(request.folder.string()));
}

// Reports a failure: beside the parts, and in Slurm's own output.
constexpr const char* tail =
    "[ $code -eq 0 ] && exit 0\n"
    "{ echo \"$code ${SLURMD_NODENAME:-$(hostname)}\"; cat \"$log\"; } >\"$failed\"\n"
    "cat \"$log\" >&2\n"
    "exit $code\n";

std::string render_of(const ArrayRequest& request) {
  return fmt::format("{} render {}{} --quiet", shell_word(request.program), shell_word(request.scene),
                     joined(request.render_words));
}

// A share of a picture, as a part, from a checkpoint where there is one.
std::string share_of_picture(const ArrayRequest& request) {
  const std::string render =
      fmt::format("{} --shard \"$number/{}\" -o \"$part\"", render_of(request), request.shards);
  return fmt::format(
      "if [ -e \"$work\" ]; then\n"
      "  run {} --resume \"$work\"\n"
      "  # One that cannot be gone on from is worth nothing.\n"
      "  grep -q 'cannot resume' \"$log\" && rm -f \"$work\" \"$work.rows\"\n"
      "fi\n"
      "[ -e \"$part\" ] || [ -e \"$work\" ] || run {} --checkpoint \"$work\"\n",
      render, render);
}

// A share of frames; those that are there are kept. Its part is empty, and says that all of them are.
std::string share_of_frames(const ArrayRequest& request) {
  return fmt::format(
      "run {}{} --shard \"$number/{}\"\n"
      "[ $code -eq 0 ] && : >\"$part\"\n",
      render_of(request), joined(request.frame_words), request.shards);
}

// The command that merges all shares; frames without a video need none.
std::string merge_of(const ArrayRequest& request) {
  if (request.frame_words.empty())
    return fmt::format("run {} merge \"$folder\"/*-of-{}.eyeray --quiet{}\n", shell_word(request.program),
                       request.shards, joined(request.merge_words));
  if (request.video.empty()) return "code=0\n";
  return fmt::format("run {}{} --video {}\n", render_of(request), joined(request.frame_words),
                     shell_word(request.video));
}

}  // namespace

std::string share_script(const ArrayRequest& request) {
  return head(request) +
         fmt::format(
             "number=$((SLURM_ARRAY_TASK_ID + $1))\n"
             "part=$folder/$number-of-{}.eyeray\n"
             "work=$folder/$number.work\n"
             "log=$folder/$number.log\n"
             "failed=$folder/$number.failed\n"
             "# What a job before it was killed at, too.\n"
             "rm -f \"$failed\" \"$part\".part.* \"$work\"*.part.*\n"
             "[ -e \"$part\" ] && exit 0\n",
             request.shards) +
         (request.frame_words.empty() ? share_of_picture(request) : share_of_frames(request)) + tail;
}

std::string merge_script(const ArrayRequest& request) {
  return head(request) +
         "log=$folder/merge.log\n"
         "failed=$folder/merge.failed\n"
         "rm -f \"$failed\" \"$folder/merged\"\n" +
         merge_of(request) + "[ $code -eq 0 ] && : >\"$folder/merged\"\n" + tail;
}

}  // namespace eyeray::slurm
