// How far a render has come.
#include <fmt/ranges.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <span>

#include "host/cli/command.hpp"
#include "host/core/readable.hpp"

namespace eyeray::cli {
namespace {

constexpr double seconds_between_bars = 0.1;
constexpr double seconds_between_lines = 5;

// Columns of the terminal on standard error, which may change at any time.
int terminal_columns() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

// Columns that a text of single-width characters in UTF-8 takes.
int columns_of(std::string_view text) {
  return int(std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

// A line that is drawn over itself, and wiped away when the last copy of the reporter goes, however the
// render ended. It never fills the terminal's last column, after which a terminal begins another line.
class Bar {
 public:
  ~Bar() {
    if (drawn_) std::fputs("\r\033[K", stderr);
  }
  // The first of `texts` that fits, behind a bar where there is room for one.
  void draw(std::span<const std::string> texts, double share) {
    const int room = terminal_columns() - 1;
    const auto text =
        std::ranges::find_if(texts, [&](const std::string& each) { return columns_of(each) <= room; });
    if (text == texts.end()) return;
    const int width = std::min(30, room - columns_of(*text) - 1);
    fmt::print(stderr, "\r{}{}\033[K", width < 5 ? "" : bar(width, share) + " ", *text);
    std::fflush(stderr);
    drawn_ = true;
  }

 private:
  std::string bar(int width, double share) const {
    const int full = int(share * width);
    std::string bar;
    for (int i = 0; i < width; ++i) bar += i < full ? "█" : "·";
    return colored_ ? "\033[36m" + bar + "\033[0m" : bar;
  }

  bool drawn_ = false;
  const bool colored_ = !std::getenv("NO_COLOR");
};

bool stderr_is_terminal() {
  const char* type = std::getenv("TERM");
  return isatty(STDERR_FILENO) && type && std::strcmp(type, "dumb") != 0;
}

// Shown before the first samples.
const std::string preparing[] = {"building BVHs and compiling kernels", "compiling kernels", "compiling"};

double share_of(const render::Progress& progress) {
  return double(progress.samples_done) / double(progress.samples_total);
}

// " band 3 of 32, sample 2 of 4"; what there is only one of is not said.
std::string place(const render::Progress& progress) {
  std::vector<std::string> parts;
  if (progress.bands > 1) parts.push_back(fmt::format("band {} of {}", progress.band + 1, progress.bands));
  if (progress.samples > 1)
    parts.push_back(fmt::format("sample {} of {}", progress.sample + 1, progress.samples));
  return parts.empty() ? "" : fmt::format("  {}", fmt::join(parts, ", "));
}

// From the longest text to the shortest. Rate and time left are those since `first`, the first report: the
// driver may compile kernels until then.
std::vector<std::string> describe(const render::Progress& progress, const render::Progress& first) {
  const std::string share = fmt::format("{:3.0f} %", share_of(progress) * 100);
  if (progress.samples_done == first.samples_done) return {share + place(progress), share};
  const double seconds = progress.seconds - first.seconds;
  const double left = seconds * double(progress.samples_total - progress.samples_done) /
                      double(progress.samples_done - first.samples_done);
  const std::string rate = "  " + format_rate(double(progress.rays - first.rays) / seconds);
  const std::string time = fmt::format("  {} left", format_seconds(left));
  return {share + place(progress) + rate + time, share + rate + time, share + time, share};
}

}  // namespace

std::shared_ptr<void> show_compiling(std::string_view and_then) {
  if (!stderr_is_terminal()) return nullptr;
  std::vector<std::string> texts(std::begin(preparing), std::end(preparing));
  for (std::string& text : texts) text += and_then;
  const auto bar = std::make_shared<Bar>();
  bar->draw(texts, 0);
  return bar;
}

std::function<void(const render::Progress&)> progress_reporter(bool quiet) {
  if (quiet) return {};
  const std::shared_ptr<Bar> bar = stderr_is_terminal() ? std::make_shared<Bar>() : nullptr;
  const double pause = bar ? seconds_between_bars : seconds_between_lines;
  return [bar, pause, next = pause,
          first = std::optional<render::Progress>()](const render::Progress& progress) mutable {
    if (progress.samples_done <= progress.samples_resumed) {
      if (bar) bar->draw(preparing, 0);
      return;
    }
    if (!first) first = progress;
    if (progress.seconds < next) return;
    next = progress.seconds + pause;
    const std::vector<std::string> texts = describe(progress, *first);
    if (bar) {
      bar->draw(texts, share_of(progress));
    } else {
      fmt::print(stderr, "{}\n", texts[0]);
    }
  };
}

}  // namespace eyeray::cli
