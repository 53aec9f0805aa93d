#include "host/shapes/planar_region.hpp"

#include <cmath>

namespace eyeray::engine::shapes {

Vec3 area_of(const Outline& outer) {
  double size = 0;
  for (const Vec3& vertex : outer) size = std::max(size, magnitude(vertex - outer[0]));
  Vec3 sum(0);
  for (size_t i = 1; i + 1 < outer.size(); ++i)
    sum += glm::cross((outer[i] - outer[0]) / size, (outer[i + 1] - outer[0]) / size);
  return sum;
}

size_t PlanarRegion::size() const {
  size_t count = outer.size();
  for (const Outline& hole : holes) count += hole.size();
  return count;
}

double PlanarRegion::thickness() const {
  return magnitude(area_of(outer));
}

Vec3 PlanarRegion::normal() const {
  const Vec3 area = area_of(outer);
  return magnitude(area) >= thinnest_region ? unit(area) : Vec3(0);
}

PlanarRegion PlanarRegion::transformed(const Affine& map) const {
  PlanarRegion region = *this;
  for (Vec3& vertex : region.outer) vertex = map.point(vertex);
  for (Outline& hole : region.holes)
    for (Vec3& vertex : hole) vertex = map.point(vertex);
  return region;
}

std::string why_out_of_range(const PlanarRegion& region) {
  double size = 0;
  for (const Vec3& vertex : region.outer) {
    if (!(magnitude(vertex) <= max_coordinate))
      return "the transformed vertices are out of range (coordinates up to 1e12)";
    size = std::max(size, magnitude(vertex - region.outer[0]));
  }
  if (size < min_radius) return "the transformed outline is too small (sizes from 1e-12)";
  return region.normal() == Vec3(0) ? "the transform leaves the outline without area" : "";
}

double signed_area(std::span<const Vec2> outline) {
  double sum = 0;
  for (size_t i = 1; i + 1 < outline.size(); ++i) {
    const Vec2 a = outline[i] - outline[0], b = outline[i + 1] - outline[0];
    sum += a.x * b.y - a.y * b.x;
  }
  return sum;
}

// Sunday, "Inclusion of a Point in a Polygon" (2001): the number of edges that pass the point upwards on its
// right, less the number that pass it downwards there.
int winding(std::span<const Vec2> outline, const Vec2& point) {
  int turns = 0;
  for (size_t i = 0; i < outline.size(); ++i) {
    const Vec2 a = outline[i] - point, b = outline[(i + 1) % outline.size()] - point;
    if ((a.y > 0) == (b.y > 0)) continue;
    const double side = a.x * b.y - a.y * b.x;
    if (b.y > a.y && side > 0) ++turns;
    if (b.y < a.y && side < 0) --turns;
  }
  return turns;
}

}  // namespace eyeray::engine::shapes
