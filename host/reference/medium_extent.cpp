#include "host/reference/medium_extent.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::reference {

namespace {

// The part of a ray inside a medium. At a distance from `begin`, the medium's density is density · exp(−decay
// · distance).
struct Column {
  double begin, end;  // equal where the ray misses the medium
  double density;     // at begin
  double decay;       // per unit of length; below 0 downwards
};

Column column(const MediumExtent& extent, const Ray& ray, double t) {
  double begin = 0, end = t;
  const Bounds box = extent.bounds();
  for (int axis = 0; axis < 3; ++axis) {
    const double o = ray.o[axis], d = ray.d[axis];
    if (d == 0 && (o < box.min[axis] || o > box.max[axis])) end = 0;
    if (d == 0) continue;
    begin = std::max(begin, ((d > 0 ? box.min : box.max)[axis] - o) / d);
    end = std::min(end, ((d > 0 ? box.max : box.min)[axis] - o) / d);
  }
  if (!(begin < end)) return {0, 0, 1, 0};
  const double y = ray.o.y + (begin > 0 ? begin * ray.d.y : 0);
  return {begin, end, std::exp((extent.base - y) / extent.scale_height), ray.d.y / extent.scale_height};
}

}  // namespace

double medium_length(const MediumExtent& extent, const Ray& ray, double t) {
  const auto [begin, end, density, decay] = column(extent, ray, t);
  const double distance = end - begin;
  return density * (decay == 0 ? distance : -std::expm1(-decay * distance) / decay);
}

double medium_distance(const MediumExtent& extent, const Ray& ray, double length) {
  const Column all = column(extent, ray, std::numeric_limits<double>::infinity());
  const double distance = length / all.density;
  return all.begin + (all.decay == 0 ? distance : -std::log1p(-all.decay * distance) / all.decay);
}

}  // namespace eyeray::engine::reference
