#include "host/shapes/cube.hpp"

#include <cmath>

namespace eyeray::engine::shapes::cube {

namespace {

double side(int face) {
  return face % 2 == 1 ? 1 : -1;
}

}  // namespace

std::optional<Span> span(const Ray& ray) {
  Span all{{-HUGE_VAL, 0}, {HUGE_VAL, 0}};
  for (int axis = 0; axis < 3; ++axis) {
    if (ray.d[axis] == 0) {
      if (std::fabs(ray.o[axis]) > 1) return std::nullopt;
      continue;
    }
    const bool up = ray.d[axis] > 0;
    const double in = ((up ? -1 : 1) - ray.o[axis]) / ray.d[axis];
    const double out = ((up ? 1 : -1) - ray.o[axis]) / ray.d[axis];
    if (in > all.in.t) all.in = {in, 2 * axis + (up ? 0 : 1)};
    if (out < all.out.t) all.out = {out, 2 * axis + (up ? 1 : 0)};
  }
  if (!(all.in.t <= all.out.t)) return std::nullopt;
  return all;
}

Mat4 placed(const Vec3& min, const Vec3& max) {
  const Vec3 half = (max - min) * 0.5;
  return {{half.x, 0, 0, 0}, {0, half.y, 0, 0}, {0, 0, half.z, 0}, {min + half, 1}};
}

Vec3 normal(int face) {
  Vec3 normal(0);
  normal[face / 2] = side(face);
  return normal;
}

Vec3 onto(int face, const Vec3& near) {
  Vec3 p = glm::clamp(near, -1.0, 1.0);
  p[face / 2] = side(face);
  return p;
}

std::pair<Vec3, Vec3> along_uv(int face, const Vec3& gradient) {
  const Vec3 rights[] = {{0, 0, -side(face)}, {1, 0, 0}, {side(face), 0, 0}};
  const Vec3 out = normal(face), right = rights[face / 2], up = glm::cross(out, right);
  const auto along = [&](const Vec3& d) {
    return 2.0 * (d - out * (glm::dot(gradient, d) / glm::dot(gradient, out)));
  };
  return {along(right), along(up)};
}

Vec2 uv(int face, const Vec3& p) {
  const Vec2 right_and_up[] = {{-p.z * side(face), p.y}, {p.x, -p.z * side(face)}, {p.x * side(face), p.y}};
  return inner_uv(right_and_up[face / 2] * 0.5 + 0.5);
}

}  // namespace eyeray::engine::shapes::cube
