#include "host/cli/frames.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>

#include "host/core/atomic_file.hpp"
#include "host/core/error.hpp"
#include "host/core/escaped_text.hpp"
#include "host/core/process.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::cli {
namespace {

constexpr int most_frames_at_once = 1'000'000;

std::optional<int> as_number(std::string_view text) {
  int number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || std::abs(number) > most_frames_at_once)
    return std::nullopt;
  return number;
}

// A placeholder for a number in a name: %d or %0Nd.
struct Placeholder {
  size_t begin;
  size_t end;
  int digits;
};

std::optional<Placeholder> number_placeholder(std::string_view pattern) {
  const size_t begin = pattern.find('%');
  if (begin == std::string_view::npos || pattern.find('%', begin + 1) != std::string_view::npos)
    return std::nullopt;
  const size_t end = pattern.find('d', begin);
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view inner = pattern.substr(begin + 1, end - begin - 1);
  if (inner.empty()) return Placeholder{begin, end + 1, 1};
  const auto digits = as_number(inner);
  if (inner[0] != '0' || !digits || *digits < 1 || *digits > 9) return std::nullopt;
  return Placeholder{begin, end + 1, *digits};
}

}  // namespace

std::vector<int> parse_frames(const std::string& text) {
  std::vector<std::optional<int>> parts;
  for (size_t begin = 0; begin <= text.size();) {
    const size_t end = std::min(text.find(':', begin), text.size());
    parts.push_back(as_number(std::string_view(text).substr(begin, end - begin)));
    begin = end + 1;
  }
  const bool whole = std::ranges::all_of(parts, [](const auto& part) { return part.has_value(); });
  const int step = whole && parts.size() == 3 ? *parts[2] : 1;
  if (!whole || parts.size() < 2 || parts.size() > 3 || step < 1 || *parts[0] > *parts[1])
    throw Error(ExitCode::bad_input,
                "--frames {}: write FIRST:LAST, such as 0:48, or FIRST:LAST:STEP; the numbers must be within "
                "±{}, and LAST at least FIRST",
                text, most_frames_at_once);
  std::vector<int> frames;
  for (int frame = *parts[0]; frame <= *parts[1]; frame += step) frames.push_back(frame);
  return frames;
}

std::string frame_name(const std::string& pattern, int frame) {
  const auto placeholder = number_placeholder(pattern);
  if (!placeholder)
    throw Error(ExitCode::bad_input,
                "{}: with --frames, the name must contain the frame's number exactly once, as %d, or as %04d "
                "for four digits",
                pattern);
  const std::string number =
      fmt::format("{}{:0{}}", frame < 0 ? "-" : "", std::abs(frame), placeholder->digits);
  return pattern.substr(0, placeholder->begin) + number + pattern.substr(placeholder->end);
}

void check_video_name(const std::string& output) {
  constexpr std::array<std::string_view, 4> endings = {".mp4", ".mkv", ".mov", ".webm"};
  if (std::ranges::find(endings, fs::path(output).extension().string()) == endings.end())
    throw Error(ExitCode::bad_input, "--video {}: a video's name must end in .mp4, .mkv, .mov or .webm",
                output);
  check_writable(output);
}

void check_video(const std::string& output) {
  check_video_name(output);
  try {
    if (run_process({"ffmpeg", "-version"}).code == 0) return;
  } catch (const Error&) {
    // A missing program is handled like one that fails.
  }
  throw Error(ExitCode::file_io, "--video needs ffmpeg, which is not installed: install it (Debian: ffmpeg)");
}

void make_video(const std::vector<fs::path>& pictures, double frames_per_second, const std::string& output) {
  const fs::path list = fmt::format("{}.list.{}", output, getpid());
  // ffmpeg chooses the format by the ending.
  const fs::path part = fs::path(output).replace_extension(
      fmt::format(".part.{}{}", getpid(), fs::path(output).extension().string()));
  std::string text = "ffconcat version 1.0\n";
  for (const fs::path& picture : pictures)
    text += fmt::format("file {}\nduration {}\n", shell_word(fs::absolute(picture).string()),
                        1 / frames_per_second);
  write_file_atomically(list, text);
  const ProcessResult result =
      run_process({"ffmpeg", "-hide_banner", "-loglevel", "error", "-y", "-f", "concat", "-safe", "0", "-i",
                   list.string(), "-r", fmt::format("{}", frames_per_second), "-pix_fmt", "yuv420p",
                   // Players want even sizes.
                   "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", part.string()},
                  {}, 24 * 3600.0);
  std::error_code ignored;
  fs::remove(list, ignored);
  if (result.code == 0) {
    std::error_code failed;
    fs::rename(part, output, failed);
    if (!failed) return;
  }
  fs::remove(part, ignored);
  throw Error(ExitCode::file_io, "ffmpeg made no video of the {} frames: {}", pictures.size(),
              result.err.empty() ? "it printed no reason" : result.err.substr(0, 500));
}

}  // namespace eyeray::engine::cli
