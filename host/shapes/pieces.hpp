// The search for the nearest of a shape's many pieces, in float64.
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "host/core/parallel_for.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/box_bvh.hpp"
#include "host/scene/shape.hpp"

namespace eyeray::engine::shapes {

class PieceSearch {
 public:
  // `bounds(i)` returns the bounds of each piece, 0 … count − 1; `all` encloses them.
  PieceSearch(size_t count, std::function<Bounds(uint32_t)> bounds, const Bounds& all)
      : count_(uint32_t(count)),
        bounds_(std::move(bounds)),
        reach_(std::max(magnitude(all.min), magnitude(all.max))) {}

  // The nearest intersection of the ray with a piece, and at the same t that of the lowest number, which is
  // its `part`. intersect(i) returns the first intersection of piece i.
  template <typename Intersect>
  std::optional<Intersection> nearest(const Ray& ray, const Intersect& intersect) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::optional<Intersection> nearest;
    const BoxRay boxes(ray, box_rounding * (magnitude(ray.o) + reach_));
    search().search(boxes, infinity, [&](uint32_t i, double limit) {
      const double entry = boxes.entry(bounds_(i));
      std::optional<Intersection> hit;
      if (entry < infinity) hit = intersect(i);
      if (!hit) return limit;
      hit->t = std::max(hit->t, entry);
      hit->part = i;
      if (nearest && !(hit->t < nearest->t || (hit->t == nearest->t && i < nearest->part))) return limit;
      nearest = hit;
      return hit->t;
    });
    return nearest;
  }

 private:
  // The BVH. It is built when the first ray comes: only the reference sends rays.
  const BoxBvh& search() const {
    std::call_once(built_, [&] {
      // The thread that builds must not take on rays of other threads, which wait for it here.
      parallel_for_alone(0, 1, [&](int) { bvh_ = BoxBvh(count_, bounds_, Acceleration::bvh); });
    });
    return bvh_;
  }

  uint32_t count_;
  std::function<Bounds(uint32_t)> bounds_;
  double reach_;
  mutable std::once_flag built_;
  mutable BoxBvh bvh_;
};

}  // namespace eyeray::engine::shapes
