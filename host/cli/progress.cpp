// How far a render has come.
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "host/cli/command.hpp"
#include "host/core/readable.hpp"

namespace eyeray::cli {
namespace {

constexpr double seconds_between_bars = 0.1;
constexpr double seconds_between_lines = 5;

// A bar that is drawn over itself, and wiped away when the last copy of the reporter goes, however the render
// ended.
class Bar {
 public:
  ~Bar() {
    if (drawn_) std::fputs("\r\033[K", stderr);
  }
  void draw(const std::string& text, double share) {
    constexpr int width = 30;
    const int full = int(share * width);
    std::string bar;
    for (int i = 0; i < width; ++i) bar += i < full ? "█" : "·";
    if (colored_) bar = "\033[36m" + bar + "\033[0m";
    fmt::print(stderr, "\r{} {}\033[K", bar, text);
    std::fflush(stderr);
    drawn_ = true;
  }

 private:
  bool drawn_ = false;
  const bool colored_ = !std::getenv("NO_COLOR");
};

bool stderr_is_terminal() {
  const char* type = std::getenv("TERM");
  return isatty(STDERR_FILENO) && type && std::strcmp(type, "dumb") != 0;
}

// " band 3 of 32, sample 2 of 4"; what there is only one of is not said.
std::string place(const render::Progress& progress) {
  std::vector<std::string> parts;
  if (progress.bands > 1) parts.push_back(fmt::format("band {} of {}", progress.band + 1, progress.bands));
  if (progress.samples > 1)
    parts.push_back(fmt::format("sample {} of {}", progress.sample + 1, progress.samples));
  return parts.empty() ? "" : fmt::format("  {}", fmt::join(parts, ", "));
}

std::string describe(const render::Progress& progress, double share) {
  const double taken = double(progress.samples_done - progress.samples_resumed);
  const double left = progress.seconds * double(progress.samples_total - progress.samples_done) / taken;
  return fmt::format("{:3.0f} %{}  {}  {} left", share * 100, place(progress),
                     format_rate(double(progress.rays) / progress.seconds), format_seconds(left));
}

}  // namespace

std::function<void(const render::Progress&)> progress_reporter(bool quiet) {
  if (quiet) return {};
  const std::shared_ptr<Bar> bar = stderr_is_terminal() ? std::make_shared<Bar>() : nullptr;
  const double pause = bar ? seconds_between_bars : seconds_between_lines;
  return [bar, pause, next = pause](const render::Progress& progress) mutable {
    if (progress.seconds < next || progress.samples_done <= progress.samples_resumed) return;
    next = progress.seconds + pause;
    const double share = double(progress.samples_done) / double(progress.samples_total);
    if (bar) {
      bar->draw(describe(progress, share), share);
    } else {
      fmt::print(stderr, "{}\n", describe(progress, share));
    }
  };
}

}  // namespace eyeray::cli
