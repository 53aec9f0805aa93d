#include "host/importers/polygon.hpp"

#include <cmath>

namespace eyeray::engine::importers {

namespace {

// Twice the signed area of the triangle: above 0 if it runs counter-clockwise.
double area(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Twice the vector area (Newell). It is right for polygons that are not quite flat, whichever corner is the
// first.
Vec3 vector_area(std::span<const Vec3> corners) {
  Vec3 sum(0.0);
  for (size_t i = 1; i + 1 < corners.size(); ++i)
    sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  return sum;
}

}  // namespace

const std::vector<std::array<uint32_t, 3>>& Triangulator::cut(std::span<const Vec3> corners) {
  triangles_.clear();
  const auto n = static_cast<uint32_t>(corners.size());
  if (n < 3) return triangles_;
  const auto fan = [&] {
    for (uint32_t i = 1; i + 1 < n; ++i) triangles_.push_back({0, i, i + 1});
  };
  if (n == 3) return fan(), triangles_;

  // Project the polygon along the main axis of its normal. A polygon without a normal will be left out in any
  // case.
  const Vec3 normal = vector_area(corners);
  const Vec3 size = glm::abs(normal);
  const int z = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  const int x = normal[z] < 0 ? (z + 2) % 3 : (z + 1) % 3;
  const int y = normal[z] < 0 ? (z + 1) % 3 : (z + 2) % 3;
  flat_.clear();
  for (const Vec3& corner : corners) flat_.emplace_back(corner[x], corner[y]);

  // A fan is right if all of its triangles have the polygon's winding.
  bool convex = true;
  for (uint32_t i = 1; i + 1 < n && convex; ++i) convex = !(area(flat_[0], flat_[i], flat_[i + 1]) < 0);
  if (convex || n > most_ear_corners || !std::isfinite(normal.x + normal.y + normal.z)) {
    if (!convex) ++fans_;
    return fan(), triangles_;
  }
  cut_ears();
  return triangles_;
}

// Clips ears until three corners are left. An ear is a corner whose triangle contains no other corner.
void Triangulator::cut_ears() {
  const auto n = static_cast<uint32_t>(flat_.size());
  before_.resize(n);
  after_.resize(n);
  for (uint32_t i = 0; i < n; ++i) {
    before_[i] = (i + n - 1) % n;
    after_[i] = (i + 1) % n;
  }
  const auto turn = [&](uint32_t i) { return area(flat_[before_[i]], flat_[i], flat_[after_[i]]); };

  const auto is_ear = [&](uint32_t i) {
    const uint32_t a = before_[i];
    const uint32_t c = after_[i];
    if (!(turn(i) > 0)) return false;
    // Only a corner that turns inward can lie in the ear. A corner that coincides with one of the ear's only
    // touches it.
    for (uint32_t p = after_[c]; p != a; p = after_[p]) {
      if (turn(p) > 0 || flat_[p] == flat_[a] || flat_[p] == flat_[i] || flat_[p] == flat_[c]) continue;
      if (area(flat_[a], flat_[i], flat_[p]) >= 0 && area(flat_[i], flat_[c], flat_[p]) >= 0 &&
          area(flat_[c], flat_[a], flat_[p]) >= 0)
        return false;
    }
    return true;
  };

  uint32_t at = 0;
  uint32_t tried = 0;
  for (uint32_t left = n; left > 3;) {
    // If there is no ear, the polygon crosses itself or has collinear corners: clip any corner.
    if (!is_ear(at) && tried < left) {
      ++tried;
      at = after_[at];
      continue;
    }
    clip(before_[at], at, after_[at]);
    at = after_[after_[at]];
    tried = 0;
    --left;
  }
  triangles_.push_back({before_[at], at, after_[at]});
}

void Triangulator::clip(uint32_t before, uint32_t ear, uint32_t after) {
  triangles_.push_back({before, ear, after});
  after_[before] = after;
  before_[after] = before;
}

}  // namespace eyeray::engine::importers
