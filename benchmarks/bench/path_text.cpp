#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "benchmarks/bench/paths.hpp"

namespace eyeray::engine::bench {
namespace {

void add_path_row(std::string& text, const char* name, const PathSeries& series,
                  const std::function<std::string(const PathLevel&)>& cell) {
  text += fmt::format("  {:<26}", name);
  for (const PathLevel& level : series.levels) text += fmt::format("{:>12}", cell(level));
  text += "\n";
}

std::string to_text(const PathSeries& series, double pixels) {
  std::string text = fmt::format("\n{} ({})\n", series.name, series.device);
  add_path_row(text, "samples a pixel", series,
               [](const PathLevel& level) { return std::to_string(level.samples); });
  const auto millions = [&](double count, double seconds) {
    return fmt::format("{:.3g}", count / seconds / 1e6);
  };
  add_path_row(text, "Mpaths/s", series, [&](const PathLevel& level) {
    return millions(pixels * level.samples, level.seconds.median);
  });
  if (series.levels.back().rays > 0)
    add_path_row(text, "Mrays/s", series,
                 [&](const PathLevel& level) { return millions(double(level.rays), level.seconds.median); });
  add_path_row(text, "Mpaths a CPU second", series, [&](const PathLevel& level) {
    return millions(pixels * level.samples, level.processor.median);
  });
  add_path_row(text, "CPU s", series,
               [](const PathLevel& level) { return fmt::format("{:.3g}", level.processor.median); });
  add_path_row(text, "CPU s, whole process", series,
               [](const PathLevel& level) { return fmt::format("{:.3g}", level.whole_processor.median); });
  if (!(series.levels.back().error > 0)) return text;
  add_path_row(text, "MSE", series,
               [](const PathLevel& level) { return fmt::format("{:.3g}", level.error); });
  add_path_row(text, "relative error, rms", series, [](const PathLevel& level) {
    return fmt::format("{:.2f} %", 100 * std::sqrt(level.relative_error));
  });
  add_path_row(text, "1 / (MSE · CPU s)", series,
               [](const PathLevel& level) { return fmt::format("{:.4g}", level.efficiency()); });
  return text + fmt::format("  MSE falls as samples to the {:.2f}\n", series.slope());
}

std::string to_text(const Likeness& likeness) {
  std::string text = fmt::format(
      "\n{} beside gpu: mean {:.6g}, {:.6g} ± {:.1g}; {} regions differ by up to {:.2g} %", likeness.name,
      likeness.theirs, likeness.ours, likeness.standard_error, likeness.regions, 100 * likeness.greatest);
  if (!likeness.judged) return text + " (it is biased)\n";
  return text + fmt::format(", {} (p = {:.2g} of {:.2g})\n",
                            likeness.within_noise() ? "within the noise" : "more than the noise", likeness.p,
                            likeness.threshold);
}

const PathSeries* find(const PathReport& report, const std::string& name) {
  const auto found = std::ranges::find(report.series, name, &PathSeries::name);
  return found == report.series.end() ? nullptr : &*found;
}

}  // namespace

std::string to_text(const PathReport& report) {
  std::string text = fmt::format("{}: {}×{}, paths; medians of {} runs, each of another seed\n", report.scene,
                                 report.width, report.height, report.runs);
  for (const PathSeries& series : report.series)
    text += to_text(series, double(report.width) * report.height);
  for (const Likeness& likeness : report.likeness) text += to_text(likeness);
  const PathSeries *const photons = find(report, "gpu, sppm"), *const paths = find(report, "gpu, path");
  if (photons && paths) {
    const EqualTime equal = at_equal_time(*paths, *photons);
    text += fmt::format("errors are against {}\nafter {:.3g} CPU seconds, RMSE, path : sppm = {:.2f}\n",
                        report.reference, equal.processor, equal.ratio);
  }
  if (const PathSeries* const cycles = find(report, "Cycles")) {
    const PathSeries& ours = report.series.front();
    const PathLevel &last = cycles->levels.back(), &own = ours.levels.back();
    text += fmt::format(
        "CPU seconds, Cycles : gpu = {:.2f} for as many samples, {:.2f} for an equal error, {:.2f} with "
        "whole "
        "processes\n",
        last.processor.median / own.processor.median,
        last.processor.median / ours.processor_until(last.error),
        last.whole_processor.median /
            (ours.processor_until(last.error) + own.whole_processor.median - own.processor.median));
  }
  return text + "\n";
}

std::string path_changes(const std::vector<PathReport>& old, const std::vector<PathReport>& now) {
  std::string text;
  for (const PathReport& report : now) {
    const auto before = std::ranges::find(old, report.scene, &PathReport::scene);
    if (before == old.end() || before->width != report.width || before->height != report.height) continue;
    for (const PathSeries& series : report.series) {
      const PathSeries* const was = find(*before, series.name);
      if (!was) continue;
      const PathLevel &a = was->levels.back(), &b = series.levels.back();
      if (a.samples != b.samples) continue;
      const auto add = [&](const char* what, double from, double to) {
        text += fmt::format("{:<24} {:<12} {:<14} {:>8.4g} -> {:<8.4g} {:>+7.1f} %\n", report.scene,
                            series.name, what, from, to, 100 * (to / from - 1));
      };
      add("CPU s", a.processor.median, b.processor.median);
      if (a.error > 0 && b.error > 0) add("MSE", a.error, b.error);
    }
  }
  return text;
}

}  // namespace eyeray::engine::bench
