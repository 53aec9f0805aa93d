#include <fmt/format.h>

#include <algorithm>

#include "benchmarks/bench/pictures.hpp"
#include "host/core/readable.hpp"

namespace eyeray::engine::bench {
namespace {

// The names that measure_pictures gives to the series of starts.
constexpr std::string_view starts[] = {"cold start", "warm start"};

std::string format_spread(const Spread& spread) {
  return fmt::format("{:>10}   {} … {}", format_seconds(spread.median), format_seconds(spread.min),
                     format_seconds(spread.max));
}

std::string to_text(const SeriesReport& series, uint64_t primitives) {
  const bool named = series.device.starts_with(series.name + ":");
  std::string text =
      fmt::format("\n{}\n", named ? series.device : fmt::format("{} ({})", series.name, series.device));
  for (const auto& [stage, seconds] : series.stages)
    text += fmt::format("  {:<16} {}\n", stage, format_spread(seconds));
  if (series.peak_memory) {
    const double memory = series.peak_memory->median;
    text += fmt::format(
        "  {:<16} {:>6.0f} MiB{}\n", "peak memory", memory / (1 << 20),
        primitives > 0 ? fmt::format("   {:.0f} bytes a primitive", memory / double(primitives)) : "");
  }
  if (series.rays > 0)
    text += fmt::format("  {:<16} {:>10}   {}\n", "rays", series.rays,
                        format_rate(double(series.rays) / series.tracing.median));
  return text;
}

// The times from the start of the program to a written picture; "" if they were not measured.
std::string first_pixel(const PictureReport& report) {
  std::string times;
  for (const SeriesReport& series : report.series) {
    if (std::ranges::find(starts, series.name) != std::end(starts))
      times += fmt::format("{}{} {}", times.empty() ? "" : ", ", series.name,
                           format_seconds(series.stages.front().second.median));
  }
  return times.empty() ? "" : fmt::format("\ntime to first pixel: {}\n", times);
}

std::string line(const PictureReport& picture, const SeriesReport& series, const std::string& what,
                 const Spread& old, const Spread& now, double unit, const char* unit_name) {
  if (!(old.median > 0)) return "";
  // If the spreads touch, both values may be the same.
  const bool apart = now.min > old.max || now.max < old.min;
  return fmt::format("{:<24} {:<12} {:<14} {:>8.4g} -> {:<8.4g} {} {:>+7.1f} %{}\n", picture.scene,
                     series.name, what, old.median / unit, now.median / unit, unit_name,
                     100 * (now.median / old.median - 1), apart ? "" : "  within the spread");
}

}  // namespace

std::string to_text(const PictureReport& report) {
  std::string text =
      fmt::format("{}: {}×{}, {} sample{} a pixel; median, least … greatest of {} runs\n", report.scene,
                  report.width, report.height, report.samples, report.samples == 1 ? "" : "s", report.runs);
  for (const SeriesReport& series : report.series) text += to_text(series, report.primitives);
  if (report.povray)
    text += fmt::format("\nPOV-Ray : gpu = {:.2f} (tracing alone), {:.2f} (whole process)\n",
                        report.povray->tracing, report.povray->whole_process);
  return text + first_pixel(report) + "\n";
}

std::string picture_changes(const std::vector<PictureReport>& old, const std::vector<PictureReport>& now) {
  std::string text;
  for (const PictureReport& picture : now) {
    const auto before = std::ranges::find(old, picture.scene, &PictureReport::scene);
    if (before == old.end() || before->width != picture.width || before->height != picture.height ||
        before->samples != picture.samples)
      continue;
    for (const SeriesReport& series : picture.series) {
      const auto was = std::ranges::find(before->series, series.name, &SeriesReport::name);
      if (was == before->series.end()) continue;
      text += line(picture, series, "whole process", was->stages.front().second, series.stages.front().second,
                   1, "s");
      text += line(picture, series, "tracing", was->tracing, series.tracing, 1, "s");
      if (was->peak_memory && series.peak_memory)
        text += line(picture, series, "memory", *was->peak_memory, *series.peak_memory, 1 << 20, "MiB");
    }
  }
  return text;
}

}  // namespace eyeray::engine::bench
