#include "host/scene/light_bvh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/core/error.hpp"
#include "host/scene/bounds.hpp"

namespace eyeray::engine {

namespace {

constexpr int bins = 12;

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

// Widens the cone around `a` by the directions of the cone around `b`.
void add_cone(LightBounds& a, const LightBounds& b) {
  a.reach = std::max(a.reach, b.reach);
  // If light leaves both sides, either direction of the axis will do.
  const bool flips = b.both_sides && glm::dot(a.axis, b.axis) < 0;
  const Vec3 axis = flips ? -b.axis : b.axis;
  a.both_sides = a.both_sides || b.both_sides;
  const double apart = angle_between(a.axis, axis);
  if (apart + b.spread <= a.spread) return;
  if (apart + a.spread <= b.spread) {
    a.axis = axis;
    a.spread = b.spread;
    return;
  }
  const double spread = (a.spread + apart + b.spread) / 2;
  const Vec3 across = glm::cross(a.axis, axis);
  if (spread >= M_PI || glm::length(across) < 1e-12) {
    a.spread = M_PI;
    return;
  }
  const Vec3 side = glm::normalize(glm::cross(across, a.axis));
  const double turn = spread - a.spread;
  a.axis = glm::normalize(std::cos(turn) * a.axis + std::sin(turn) * side);
  a.spread = spread;
}

// The bounds of a range of lights, and the box by which the range is split.
struct Cluster {
  Bounds box;
  LightBounds cone;  // power and directions alone
  size_t count = 0;

  void add(const LightBounds& light) {
    box.include(light.center - Vec3(light.radius));
    box.include(light.center + Vec3(light.radius));
    add_directions(light);
    ++count;
  }
  void add(const Cluster& other) {
    if (other.count == 0) return;
    box.include(other.box.min);
    box.include(other.box.max);
    add_directions(other.cone);
    count += other.count;
  }

  // The power, times the box's squared diagonal, times the solid angle of the directions in which light is
  // emitted, weighted by cosine.
  double cost() const {
    if (count == 0) return 0;
    const double o = cone.spread, w = std::min(o + cone.reach, M_PI);
    const double directions =
        2 * M_PI * (1 - std::cos(o)) +
        M_PI / 2 * (2 * w * std::sin(o) - std::cos(o - 2 * w) - 2 * o * std::sin(o) + std::cos(o));
    const Vec3 size = box.max - box.min;
    return cone.power * directions * (cone.both_sides ? 2 : 1) * glm::dot(size, size);
  }

 private:
  void add_directions(const LightBounds& light) {
    const double power = cone.power + light.power;
    if (count == 0)
      cone = light;
    else
      add_cone(cone, light);
    cone.power = power;
  }
};

class Builder {
 public:
  Builder(std::span<const LightBounds> lights, LightBvh& bvh) : lights_(lights), bvh_(bvh) {
    bvh.trails.assign(lights.size(), LightBvh::no_trail);
    for (size_t i = 0; i < lights.size(); ++i)
      if (lights[i].power > 0) order_.push_back(uint32_t(i));
    if (order_.size() < 2) return;
    CHECK_LE(order_.size(), size_t{1} << (LightBvh::deepest - 1));
    bvh.nodes.reserve(2 * order_.size());
    split(0, order_.size(), 0, 0);
  }

 private:
  // Appends the pair of nodes that divide the range, and returns the pair's index.
  uint32_t split(size_t begin, size_t end, int level, uint32_t trail) {
    const size_t middle = split_index(begin, end, level);
    const auto pair = uint32_t(bvh_.nodes.size());
    bvh_.nodes.resize(bvh_.nodes.size() + 2);
    bvh_.nodes[pair] = node(begin, middle, level, trail);
    const LightBvh::Node second = node(middle, end, level, trail | 1u << level);
    bvh_.nodes[pair + 1] = second;
    return pair;
  }

  LightBvh::Node node(size_t begin, size_t end, int level, uint32_t trail) {
    const LightBounds bounds = bounds_of(begin, end);
    if (end - begin > 1) {
      const uint32_t child = split(begin, end, level + 1, trail);
      return {bounds, false, child};
    }
    bvh_.trails[order_[begin]] = trail;
    return {bounds, true, order_[begin]};
  }

  LightBounds bounds_of(size_t begin, size_t end) const {
    Cluster all;
    for (size_t i = begin; i < end; ++i) all.add(lights_[order_[i]]);
    LightBounds bounds = all.cone;
    if (end - begin > 1) bounds.center = (all.box.min + all.box.max) / 2.0;
    bounds.radius = 0;
    for (size_t i = begin; i < end; ++i) {
      const LightBounds& light = lights_[order_[i]];
      bounds.radius = std::max(bounds.radius, glm::length(light.center - bounds.center) + light.radius);
    }
    return bounds;
  }

  // Sorts the range, and returns where it is split: the lights before that belong to the first child.
  size_t split_index(size_t begin, size_t end, int level) {
    if (end - begin == 2) return begin + 1;
    // The remaining levels must suffice for the larger half.
    if (end - begin > size_t{1} << (LightBvh::deepest - level - 2)) return halves(begin, end);
    Bounds centers;
    for (size_t i = begin; i < end; ++i) centers.include(lights_[order_[i]].center);
    const Vec3 size = centers.max - centers.min;
    const double largest = std::max({size.x, size.y, size.z});
    if (!(largest > 0)) return halves(begin, end);

    double least = std::numeric_limits<double>::infinity();
    int best_axis = 0, best_bin = 0;
    for (int axis = 0; axis < 3; ++axis) {
      if (!(size[axis] > 0)) continue;
      std::array<Cluster, bins> content;
      for (size_t i = begin; i < end; ++i)
        content[size_t(bin(lights_[order_[i]], centers, axis))].add(lights_[order_[i]]);
      std::array<double, bins> after{};
      Cluster behind;
      for (int i = bins - 1; i > 0; --i) {
        behind.add(content[size_t(i)]);
        after[size_t(i)] = behind.count > 0 ? behind.cost() : std::numeric_limits<double>::infinity();
      }
      Cluster before;
      for (int i = 0; i + 1 < bins; ++i) {
        before.add(content[size_t(i)]);
        if (before.count == 0) continue;
        // The last factor favours cuts across the longest axis.
        const double cost = (before.cost() + after[size_t(i + 1)]) * largest / size[axis];
        if (cost < least) {
          least = cost;
          best_axis = axis;
          best_bin = i;
        }
      }
    }
    const auto first = order_.begin() + std::ptrdiff_t(begin), last = order_.begin() + std::ptrdiff_t(end);
    const auto middle = std::stable_partition(
        first, last, [&](uint32_t light) { return bin(lights_[light], centers, best_axis) <= best_bin; });
    const auto index = size_t(middle - order_.begin());
    return index > begin && index < end ? index : halves(begin, end);
  }

  static int bin(const LightBounds& light, const Bounds& centers, int axis) {
    const double share = (light.center[axis] - centers.min[axis]) / (centers.max[axis] - centers.min[axis]);
    return std::clamp(int(share * bins), 0, bins - 1);
  }

  // Sorts the range along its longest axis, and splits it into halves with equal numbers of lights.
  size_t halves(size_t begin, size_t end) {
    Bounds centers;
    for (size_t i = begin; i < end; ++i) centers.include(lights_[order_[i]].center);
    const Vec3 size = centers.max - centers.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::stable_sort(
        order_.begin() + std::ptrdiff_t(begin), order_.begin() + std::ptrdiff_t(end),
        [&](uint32_t a, uint32_t b) { return lights_[a].center[axis] < lights_[b].center[axis]; });
    return begin + (end - begin) / 2;
  }

  std::span<const LightBounds> lights_;
  LightBvh& bvh_;
  std::vector<uint32_t> order_;
};

}  // namespace

LightBvh light_bvh(std::span<const LightBounds> lights) {
  LightBvh bvh;
  Builder(lights, bvh);
  return bvh;
}

}  // namespace eyeray::engine
