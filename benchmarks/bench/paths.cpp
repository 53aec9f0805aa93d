#include "benchmarks/bench/paths.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::bench {
namespace {

// y at x on the curve through two points that is a straight line in logarithms.
double on_line(double x, double x1, double y1, double x2, double y2) {
  return std::exp(std::log(y1) + std::log(y2 / y1) * std::log(x / x1) / std::log(x2 / x1));
}

}  // namespace

double PathSeries::slope() const {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const PathLevel& level : levels) {
    if (!(level.error > 0)) continue;
    const double a = std::log(level.samples), b = std::log(level.error);
    n += 1, x += a, y += b, xx += a * a, xy += a * b;
  }
  return n > 1 ? (n * xy - x * y) / (n * xx - x * x) : 0;
}

double PathSeries::processor_until(double error) const {
  size_t i = 1;
  while (i + 1 < levels.size() && levels[i].error > error) ++i;
  if (i >= levels.size()) return levels.front().processor.median * levels.front().error / error;
  const PathLevel &before = levels[i - 1], &after = levels[i];
  if (!(before.error > after.error)) return after.processor.median * after.error / error;
  return on_line(error, before.error, before.processor.median, after.error, after.processor.median);
}

double PathSeries::error_after(double processor) const {
  const auto left = [&](const PathLevel& level) {
    return level.error * std::pow(processor / level.processor.median, slope());
  };
  if (levels.size() < 2 || processor <= levels.front().processor.median) return left(levels.front());
  size_t i = 1;
  while (i < levels.size() && levels[i].processor.median < processor) ++i;
  if (i == levels.size()) return left(levels.back());
  const PathLevel &before = levels[i - 1], &after = levels[i];
  return on_line(processor, before.processor.median, before.error, after.processor.median, after.error);
}

EqualTime at_equal_time(const PathSeries& first, const PathSeries& second) {
  const double processor =
      std::min(first.levels.back().processor.median, second.levels.back().processor.median);
  return {processor, std::sqrt(first.error_after(processor) / second.error_after(processor))};
}

}  // namespace eyeray::engine::bench
