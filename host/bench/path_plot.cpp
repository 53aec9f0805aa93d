// Error over samples, both logarithmic: each scene in its colour, renderers and samplers by their strokes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/bench/paths.hpp"
#include "host/bench/svg.hpp"

namespace eyeray::bench {
namespace {

constexpr double plot_width = 460, plot_height = 340, plot_margin = 60, legend_width = 300;

bool has_error(const PathLevel& level) {
  return level.error > 0;
}

class PathPlot {
 public:
  explicit PathPlot(const std::vector<PathReport>& reports)
      : reports_(reports),
        svg_(plot_margin + plot_width + 20 + legend_width,
             std::max(2 * plot_margin + plot_height, plot_margin + 34.0 * double(reports.size()) + 40)) {
    for_each([&](const PathSeries& series, size_t) {
      for (const PathLevel& level : series.levels) {
        if (!has_error(level)) continue;
        const double x = std::log2(level.samples), y = std::log10(level.error);
        left_ = std::min(left_, std::floor(x));
        right_ = std::max(right_, std::ceil(x));
        bottom_ = std::min(bottom_, std::floor(y));
        top_ = std::max(top_, std::ceil(y));
      }
    });
    if (left_ > right_) left_ = bottom_ = 0, right_ = top_ = 1;
    if (left_ == right_) ++right_;
    if (bottom_ == top_) ++top_;
  }

  std::string draw() {
    axes();
    for_each([&](const PathSeries& series, size_t scene) { curve(series, scene); });
    for (size_t i = 0; i < reports_.size(); ++i) {
      const double y = plot_margin + 34.0 * double(i), x = plot_margin + plot_width + 24;
      svg_.box({x, y - 10}, {12, 12}, color(i));
      svg_.text({x + 18, y}, reports_[i].scene);
      std::string slopes;
      for (const PathSeries& series : reports_[i].series)
        if (has_error(series.levels.back()))
          slopes += fmt::format("{}{} {:.2f}", slopes.empty() ? "" : ", ", series.name, series.slope());
      svg_.text({x + 18, y + 14}, slopes, "start", 11);
    }
    return svg_.finished();
  }

 private:
  template <typename Visit>
  void for_each(const Visit& visit) {
    for (size_t i = 0; i < reports_.size(); ++i)
      for (const PathSeries& series : reports_[i].series) visit(series, i);
  }
  static std::string_view color(size_t scene) { return plot_colors[scene % std::size(plot_colors)]; }
  Vec2 place(double x, double y) const {
    return {plot_margin + (x - left_) / (right_ - left_) * plot_width,
            plot_margin + (1 - (y - bottom_) / (top_ - bottom_)) * plot_height};
  }

  void axes() {
    for (double x = left_; x <= right_; ++x) {
      svg_.line(place(x, bottom_), place(x, top_), grid_color);
      svg_.text(place(x, bottom_) + Vec2(0, 16), fmt::format("{}", std::lround(std::exp2(x))), "middle");
    }
    for (double y = bottom_; y <= top_; ++y) {
      svg_.line(place(left_, y), place(right_, y), grid_color);
      svg_.text(place(left_, y) + Vec2(-6, 4), fmt::format("1e{}", int(y)), "end");
    }
    svg_.line(place(left_, bottom_), place(right_, bottom_), axis_color);
    svg_.line(place(left_, bottom_), place(left_, top_), axis_color);
    svg_.text({plot_margin + plot_width / 2, plot_margin - 26}, "mean squared error over samples a pixel",
              "middle", 13);
    svg_.text({plot_margin + plot_width / 2, plot_margin - 10},
              "whole lines: Sobol'; thin: random; thin with dots: others. Dotted grey: 1 / samples", "middle",
              11);
    // Where independent samples would go.
    for (double x = left_; x + 0.1 < right_; x += 0.2) {
      const double y = top_ - (x - left_) * std::log10(2.0);
      if (y - 0.03 > bottom_)
        svg_.line(place(x, y), place(x + 0.1, y - 0.1 * std::log10(2.0)), "#999999", 1.5);
    }
  }

  void curve(const PathSeries& series, size_t scene) {
    std::vector<Vec2> points;
    for (const PathLevel& level : series.levels)
      if (has_error(level)) points.push_back(place(std::log2(level.samples), std::log10(level.error)));
    const bool other = !series.name.starts_with("gpu");
    if (points.size() > 1) svg_.polyline(points, color(scene), series.name == "gpu" ? 2.5 : 1);
    if (other)
      for (const Vec2& point : points) svg_.dot(point, color(scene));
  }

  const std::vector<PathReport>& reports_;
  Svg svg_;
  double left_ = std::numeric_limits<double>::infinity(), right_ = -left_, bottom_ = left_, top_ = -left_;
};

}  // namespace

std::string to_svg(const std::vector<PathReport>& reports) {
  return PathPlot(reports).draw();
}

}  // namespace eyeray::bench
