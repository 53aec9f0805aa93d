// Shows the progress of a render.
#include <fmt/ranges.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host/cli/command.hpp"
#include "host/core/readable.hpp"
#include "host/program/bar.hpp"

namespace eyeray::engine::cli {
namespace {

constexpr double seconds_between_bars = 0.1;
constexpr double seconds_between_lines = 5;

double share_of(const render::Progress& progress) {
  if (progress.denoised) return *progress.denoised;
  return double(progress.samples_done) / double(progress.samples_total);
}

// " band 3 of 32, sample 2 of 4"; a number whose total is one is left out.
std::string position_text(const render::Progress& progress) {
  std::vector<std::string> parts;
  if (progress.bands > 1) parts.push_back(fmt::format("band {} of {}", progress.band + 1, progress.bands));
  if (progress.samples > 1)
    parts.push_back(fmt::format("sample {} of {}", progress.sample + 1, progress.samples));
  return parts.empty() ? "" : fmt::format("  {}", fmt::join(parts, ", "));
}

// Texts for the progress, from the longest to the shortest. Rate and time left count from `first`, the first
// report: the driver may compile kernels until then.
std::vector<std::string> describe(const render::Progress& progress, const render::Progress& first) {
  const std::string share = fmt::format("{:3.0f} %", share_of(progress) * 100);
  if (progress.denoised) return {share + "  denoising", share};
  if (progress.samples_done == first.samples_done) return {share + position_text(progress), share};
  const double seconds = progress.seconds - first.seconds;
  const double left = seconds * double(progress.samples_total - progress.samples_done) /
                      double(progress.samples_done - first.samples_done);
  const std::string rate = "  " + format_rate(double(progress.rays - first.rays) / seconds);
  const std::string time = fmt::format("  {} left", format_seconds(left));
  return {share + position_text(progress) + rate + time, share + rate + time, share + time, share};
}

}  // namespace

std::function<void(const render::Progress&)> progress_reporter(bool quiet) {
  if (quiet) return {};
  const std::shared_ptr<Bar> bar = Bar::on_terminal();
  const double pause = bar ? seconds_between_bars : seconds_between_lines;
  return [bar, pause, next = pause,
          first = std::optional<render::Progress>()](const render::Progress& progress) mutable {
    if (!progress.denoised && progress.samples_done <= progress.samples_resumed) {
      if (bar) bar->draw(compiling_texts(), 0);
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

}  // namespace eyeray::engine::cli
