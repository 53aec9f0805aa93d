// How far a render has come, and how numbers are said to people.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "host/cli/command.hpp"

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
std::string place(const Progress& progress) {
  std::vector<std::string> parts;
  if (progress.bands > 1) parts.push_back(fmt::format("band {} of {}", progress.band + 1, progress.bands));
  if (progress.samples > 1)
    parts.push_back(fmt::format("sample {} of {}", progress.sample + 1, progress.samples));
  return parts.empty() ? "" : fmt::format("  {}", fmt::join(parts, ", "));
}

std::string describe(const Progress& progress, double share) {
  const double taken = double(progress.samples_done - progress.samples_resumed);
  const double left = progress.seconds * double(progress.samples_total - progress.samples_done) / taken;
  return fmt::format("{:3.0f} %{}  {}  {} left", share * 100, place(progress),
                     format_rate(double(progress.rays) / progress.seconds), format_seconds(left));
}

}  // namespace

std::function<void(const Progress&)> progress_reporter(bool quiet) {
  if (quiet) return {};
  const std::shared_ptr<Bar> bar = stderr_is_terminal() ? std::make_shared<Bar>() : nullptr;
  const double pause = bar ? seconds_between_bars : seconds_between_lines;
  return [bar, pause, next = pause](const Progress& progress) mutable {
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

std::string format_rate(double rays_per_second) {
  if (!(rays_per_second >= 0)) return "– rays/s";
  if (rays_per_second >= 1e9) return fmt::format("{:.3g} Grays/s", rays_per_second * 1e-9);
  if (rays_per_second >= 1e6) return fmt::format("{:.3g} Mrays/s", rays_per_second * 1e-6);
  return fmt::format("{:.3g} krays/s", rays_per_second * 1e-3);
}

std::string format_seconds(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.0f} µs", seconds * 1e6);
  if (seconds < 1) return fmt::format("{:.3g} ms", seconds * 1e3);
  if (seconds < 60) return fmt::format("{:.3g} s", seconds);
  const auto whole = int64_t(std::min(seconds, 1e15) + 0.5);
  if (seconds < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace eyeray::cli
