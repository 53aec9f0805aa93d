// Integrals along rays through a medium that has an extent, by Simpson's rule, and the phase function of
// media.
#pragma once

#include <algorithm>
#include <cmath>

#include "host/scene/medium_extent.hpp"

namespace eyeray::engine::test {

// The share of scattered light per steradian at an angle to its old direction (Henyey and Greenstein 1941).
inline double henyey_greenstein(double g, double cosine) {
  return (1 - g * g) / (4 * M_PI * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

// ∫ f(t, density) dt over the part of the ray up to `end` that is in the medium's box.
template <typename Function>
double along(const MediumExtent& extent, const Ray& ray, double end, int steps, const Function& f) {
  double from = 0, to = end;
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.o[axis], d = ray.d[axis];
    if (d == 0) {
      if (o < extent.min[axis] || o > extent.max[axis]) return 0;
    } else {
      const double a = (extent.min[axis] - o) / d, b = (extent.max[axis] - o) / d;
      from = std::max(from, std::min(a, b));
      to = std::min(to, std::max(a, b));
    }
  }
  if (!(from < to)) return 0;
  double sum = 0;
  for (int i = 0; i <= steps; ++i) {
    const double t = from + (to - from) * i / steps;
    const double density = std::exp((extent.base - ray.o.y - t * ray.d.y) / extent.scale_height);
    sum += (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2) * f(t, density);
  }
  return sum * (to - from) / (3 * steps);
}

// The integral of the medium's density along the ray.
inline double length_in(const MediumExtent& extent, const Ray& ray, double end, int steps) {
  return along(extent, ray, end, steps, [](double, double density) { return density; });
}

}  // namespace eyeray::engine::test
