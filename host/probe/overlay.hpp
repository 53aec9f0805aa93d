// The ray trees of one sample by several executors, laid over each other. The order in
// which they were recorded does not matter: rays are matched by their way through the tree, values by names.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/core/ray_tree.hpp"

namespace eyeray::engine::probe {

// The judgement of a line's values, or of which executors have a ray. `explained`, as in verify: the
// reference itself differs by as much within a few thousandths of a pixel.
enum class Verdict { agrees, explained, differs };

// The range of the reference's values around the pixel.
struct Range {
  std::array<double, 4> low, high;
  std::vector<double> whole;  // for whole numbers and truths: each value that occurs

  explicit Range(const ProbedValue& value);
  void include(const ProbedValue& value);
};

struct Line {
  std::string name;
  std::vector<std::optional<ProbedValue>> values;  // values of each executor
  std::optional<Range> range = {};
  Verdict verdict = Verdict::agrees;
  std::string difference = {};  // "gpu and twin: 3 ULP"; empty where they agree
};

struct Ray {
  RayKind kind;
  uint32_t number;           // see ProbedRay
  size_t parent;             // its index in Overlay::rays
  size_t index;              // how many of the parent's lines come before it
  std::vector<bool> traced;  // by each executor
  std::vector<size_t> children = {};
  std::vector<Line> lines = {};
  bool missed_around = false;         // whether the reference lacks the ray at some point around the pixel
  bool traced_around = false;         // whether the reference has the ray at some point around the pixel
  Verdict verdict = Verdict::agrees;  // verdict of `traced`
  std::string difference = {};
};

class Overlay {
 public:
  explicit Overlay(size_t executors);

  // Adds the tree of an executor. All these trees must come before those of add_around.
  void add(size_t executor, const RayTree& tree);
  // Adds a tree of the reference, at the pixel or at a point around it.
  void add_around(const RayTree& tree);

  // The pixel first, each ray after its parent.
  std::vector<Ray>& rays() { return rays_; }
  const std::vector<Ray>& rays() const { return rays_; }

  // Calls ray(i) for each ray and line(i, k) for each line, in the order of a ray's life: its lines with its
  // shadow rays among them, then the rays that it leads to.
  template <typename OnRay, typename OnLine>
  void in_order(const OnRay& ray, const OnLine& line, size_t from = 0) const {
    ray(from);
    const std::vector<size_t> below = children_in_order(from);
    size_t next = 0;
    for (size_t k = 0; k <= rays_[from].lines.size(); ++k) {
      for (; next < below.size() && rays_[below[next]].index <= k; ++next) in_order(ray, line, below[next]);
      if (k < rays_[from].lines.size()) line(from, k);
    }
    for (; next < below.size(); ++next) in_order(ray, line, below[next]);
  }
  // The number of rays that lead to `ray`; 0 for the camera ray.
  int depth(size_t ray) const;

 private:
  std::vector<size_t> children_in_order(size_t ray) const;

  size_t executors_;
  std::vector<Ray> rays_;
};

// The line of a ray with that name, or null.
const Line* find_line(const Ray& ray, std::string_view name);

}  // namespace eyeray::engine::probe
