#include "host/verify/evidence.hpp"

#include "host/compare/cause_picture.hpp"
#include "host/core/error.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/process.hpp"
#include "host/image/false_color.hpp"
#include "host/image/image_file.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::verify {
namespace {

// The command that this process was started with, as a shell runs it from any folder.
std::string own_command_line() {
  const std::vector<std::string> words = own_command();
  std::string line = fmt::format("cd {} && {}", shell_word(fs::current_path().string()),
                                 shell_word(fs::read_symlink("/proc/self/exe").string()));
  for (size_t i = 1; i < words.size(); ++i) line += " " + shell_word(words[i]);
  return line;
}

}  // namespace

void keep_evidence(const fs::path& folder, std::span<const compare::Frame> frames,
                   std::span<const std::vector<compare::PixelOutcome>> outcomes,
                   const compare::Report& report) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw Error(ExitCode::file_io, "cannot make the folder {}: {}", folder.string(), error.message());

  const compare::Frame& reference = frames.back();
  for (size_t i = 0; i < frames.size(); ++i) {
    const std::string& name = report.participants[i].name;
    const image::Image& picture = frames[i].color;
    if (!image::image_size_allowed(picture.width(), picture.height())) continue;
    image::write_image(folder / (name + ".pfm"), picture);
    if (i + 1 == frames.size() || !picture.same_size(reference.color)) continue;
    image::write_image(
        folder / (name + "-difference.png"),
        image::false_color(compare::log_difference(picture, reference.color), image::FalseColor::scalar));
    if (outcomes[i].empty()) continue;
    image::write_image(folder / (name + "-causes.png"), compare::cause_picture(reference.color, outcomes[i]));
    write_file_atomically(folder / (name + "-causes.json"), compare::cause_legend(outcomes[i]));
  }
  if (report.golden && report.golden->incomparable.empty())
    image::write_image(folder / "golden-difference.png",
                       image::false_color(compare::log_difference(report.golden->picture, frames[0].color),
                                          image::FalseColor::scalar));
  write_file_atomically(folder / "command.txt", own_command_line() + "\n");
}

}  // namespace eyeray::engine::verify
