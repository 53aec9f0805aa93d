// The field as a picture: rays a second over primitives, on logarithmic axes, and ratios as bars.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "host/bench/field.hpp"
#include "host/bench/svg.hpp"

namespace eyeray::bench {
namespace {

constexpr double panel_width = 320, panel_height = 260, margin = 60, bar_height = 12;

// The name under which a timing is drawn: packets of any size count as one contender, the fastest of them.
std::string drawn_name(const Timing& timing) {
  return timing.kind == ContenderKind::packet ? "Embree packets" : timing.contender;
}

bool is_drawn(const BatchReport& batch, const Timing& timing) {
  return timing.seconds.median > 0 && batch.rays > 0 &&
         (timing.kind != ContenderKind::packet || &timing == fastest(batch, ContenderKind::packet));
}

// Every drawn contender and batch of a report, in the order of first appearance.
struct Cast {
  explicit Cast(const FieldReport& report) {
    const auto add = [](std::vector<std::string>& names, const std::string& name) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    };
    for (const SceneReport& scene : report) {
      for (const BatchReport& batch : scene.batches) {
        add(batches, batch.name);
        for (const Timing& timing : batch.timings) {
          if (is_drawn(batch, timing)) add(contenders, drawn_name(timing));
        }
      }
    }
  }
  std::string_view color(const std::string& contender) const {
    const auto at = std::find(contenders.begin(), contenders.end(), contender) - contenders.begin();
    return plot_colors[size_t(at) % std::size(plot_colors)];
  }

  std::vector<std::string> batches;
  std::vector<std::string> contenders;
};

// Whole powers of ten around values.
struct LogAxis {
  int low = 100, high = -100;
  void include(double value) {
    low = std::min(low, int(std::floor(std::log10(value))));
    high = std::max(high, int(std::ceil(std::log10(value))));
  }
  void finish() {
    if (low > high) low = high = 0;
    if (low == high) ++high;
  }
  // From 0 to 1.
  double place(double value) const { return (std::log10(value) - low) / (high - low); }
};

std::string power_label(int exponent) {
  constexpr const char* units[] = {"", "k", "M", "G", "T"};
  if (exponent < 0 || exponent > 14) return fmt::format("1e{}", exponent);
  return fmt::format("{}{}", std::lround(std::pow(10, exponent % 3)), units[exponent / 3]);
}

class Plot {
 public:
  explicit Plot(const FieldReport& report)
      : report_(report), cast_(report), svg_(width(), 2 * margin + panel_height + bars_height()) {
    for (const SceneReport& scene : report_) {
      for (const BatchReport& batch : scene.batches) {
        for (const Timing& timing : batch.timings) {
          if (!is_drawn(batch, timing)) continue;
          sizes_.include(double(std::max<uint64_t>(1, scene.primitives)));
          rates_.include(rate(batch, timing));
        }
      }
    }
    sizes_.finish();
    rates_.finish();
  }

  std::string draw() {
    legend();
    for (size_t i = 0; i < cast_.batches.size(); ++i) {
      left_ = margin + double(i) * (panel_width + margin);
      axes(cast_.batches[i]);
      lines(cast_.batches[i]);
    }
    bars();
    return svg_.finished();
  }

 private:
  double width() const {
    return margin + double(std::max<size_t>(1, cast_.batches.size())) * (panel_width + margin);
  }
  // Scenes × batches × our contenders.
  size_t bar_count() const {
    size_t count = 0;
    for (const SceneReport& scene : report_) {
      for (const BatchReport& batch : scene.batches)
        count += size_t(std::ranges::count(batch.timings, ContenderKind::ours, &Timing::kind));
    }
    return count;
  }
  double bars_height() const { return double(bar_count()) * (bar_height + 6) + margin; }
  Vec2 place(double size, double rate) const {
    return {left_ + sizes_.place(size) * panel_width, margin + (1 - rates_.place(rate)) * panel_height};
  }

  void legend() {
    double x = margin;
    for (const std::string& contender : cast_.contenders) {
      svg_.box({x, 14}, {12, 12}, cast_.color(contender));
      svg_.text({x + 18, 25}, contender);
      x += 40 + 7.0 * double(contender.size());
    }
  }

  void axes(const std::string& batch) {
    for (int e = sizes_.low; e <= sizes_.high; ++e) {
      const double x = place(std::pow(10, e), 1).x;
      svg_.line({x, margin}, {x, margin + panel_height}, grid_color);
      svg_.text({x, margin + panel_height + 16}, power_label(e), "middle");
    }
    for (int e = rates_.low; e <= rates_.high; ++e) {
      const double y = place(1, std::pow(10, e)).y;
      svg_.line({left_, y}, {left_ + panel_width, y}, grid_color);
      svg_.text({left_ - 6, y + 4}, power_label(e), "end");
    }
    svg_.line({left_, margin + panel_height}, {left_ + panel_width, margin + panel_height}, axis_color);
    svg_.line({left_, margin}, {left_, margin + panel_height}, axis_color);
    svg_.text({left_ + panel_width / 2, margin - 10}, batch + ": rays a second over primitives", "middle",
              13);
  }

  void lines(const std::string& name) {
    std::map<std::pair<std::string, std::string>, std::vector<Vec2>> curves;  // by contender and family
    for (const SceneReport& scene : report_) {
      for (const BatchReport& batch : scene.batches) {
        if (batch.name != name) continue;
        for (const Timing& timing : batch.timings) {
          if (!is_drawn(batch, timing)) continue;
          curves[{drawn_name(timing), scene.family}].push_back(
              place(double(std::max<uint64_t>(1, scene.primitives)), rate(batch, timing)));
        }
      }
    }
    for (auto& [key, points] : curves) {
      std::ranges::sort(points, {}, &Vec2::x);
      if (points.size() > 1) svg_.polyline(points, cast_.color(key.first));
      for (const Vec2& point : points) svg_.dot(point, cast_.color(key.first));
    }
  }

  // Ours over Embree's single rays; the line is where both are as fast.
  void bars() {
    double longest = 1.5;
    for_each_bar([&](const SceneReport&, const BatchReport&, const Timing&, double ratio) {
      longest = std::max(longest, ratio);
    });
    const double names = 330, scale = (width() - names - 2 * margin) / longest;
    double y = 2 * margin + panel_height;
    if (bar_count() > 0) svg_.text({names, y - 12}, "times as fast as Embree's single rays", "start", 13);
    const double top = y;
    for_each_bar([&](const SceneReport& scene, const BatchReport& batch, const Timing& timing, double ratio) {
      svg_.text({names - 8, y + bar_height - 2}, scene.scene + ", " + batch.name, "end");
      svg_.box({names, y}, {ratio * scale, bar_height}, cast_.color(timing.contender));
      svg_.text({names + ratio * scale + 5, y + bar_height - 2}, fmt::format("{:.2f}", ratio), "start", 11);
      y += bar_height + 6;
    });
    if (y > top) svg_.line({names + scale, top - 6}, {names + scale, y}, axis_color);
  }

  template <typename Visit>
  void for_each_bar(const Visit& visit) const {
    for (const SceneReport& scene : report_) {
      for (const BatchReport& batch : scene.batches) {
        for (const Timing& timing : batch.timings) {
          if (timing.kind != ContenderKind::ours) continue;
          if (const double ratio = times_as_fast(batch, timing, ContenderKind::single); ratio > 0)
            visit(scene, batch, timing, ratio);
        }
      }
    }
  }

  const FieldReport& report_;
  Cast cast_;
  Svg svg_;
  LogAxis sizes_, rates_;
  double left_ = 0;  // of the panel being drawn
};

}  // namespace

std::string to_svg(const FieldReport& report) {
  return Plot(report).draw();
}

}  // namespace eyeray::bench
