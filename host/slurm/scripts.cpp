// The shell scripts that the jobs run: short, for a site to read and to edit.
#include <fmt/format.h>

#include "host/core/error.hpp"
#include "host/core/escaped_text.hpp"
#include "host/slurm/array.hpp"

namespace eyeray::engine::slurm {
namespace {

constexpr const char* head = R"(#!/bin/sh
# eyeray slurm wrote this once, and keeps what you change.
#SBATCH --requeue{}
cd {} || exit 4
)";

constexpr const char* share_of_frames = R"(share=$((SLURM_ARRAY_TASK_ID + ${{1:-0}}))
exec {0} --shard "$share/{1}"
)";

constexpr const char* share_of_picture = R"(share=$((SLURM_ARRAY_TASK_ID + ${{1:-0}}))
part={2}/$share-of-{1}.eyeray
work={2}/$share.work
[ -e "$part" ] && exit
# A job that was killed leaves these.
rm -f "$part".part.* "$work"*.part.*
render() {{
  {0} --shard "$share/{1}" -o "$part" "$@" &
  wait $!
}}
# Slurm warns before the time is over: the task waits in the queue again, to go on from its checkpoint.
trap 'kill $!; wait $!; [ -e "$work" ] && scontrol requeue "$SLURM_JOB_ID"; exit 143' USR1
trap 'kill $!; wait $!; exit 143' TERM
if [ -e "$work" ]; then
  render --resume "$work"
  code=$?
  [ $code -eq {3} ] || exit $code
  # Nothing goes on from this checkpoint: it is damaged, or of another device.
  rm -f "$work" "$work.rows"
fi
render --checkpoint "$work"
)";

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += " " + shell_word(word);
  return text;
}

std::string head_of(const char* options) {
  return fmt::format(head, options, shell_word(std::filesystem::current_path().string()));
}

std::string render_of(const Array& array) {
  return fmt::format("{} render{} --quiet", shell_word(array.program), joined(array.render_words));
}

}  // namespace

std::filesystem::path Array::part(int share) const {
  return folder / fmt::format("{}-of-{}.eyeray", share, shards);
}

std::string share_script(const Array& array) {
  const std::string render = render_of(array);
  if (!array.is_picture()) return head_of("") + fmt::format(share_of_frames, render, array.shards);
  return head_of(" --signal=B:USR1@60") + fmt::format(share_of_picture, render, array.shards,
                                                      shell_word(array.folder.string()),
                                                      int(ExitCode::cannot_resume));
}

std::string merge_script(const Array& array) {
  const std::string folder = shell_word(array.folder.string()),
                    merge = fmt::format("{} merge {}/*-of-{}.eyeray --quiet", shell_word(array.program),
                                        folder, array.shards);
  return head_of("") + fmt::format("rm -f {0}/merged\n{1}{2} && : >{0}/merged\n", folder,
                                   array.is_picture() ? merge : render_of(array), joined(array.last_words));
}

}  // namespace eyeray::engine::slurm
