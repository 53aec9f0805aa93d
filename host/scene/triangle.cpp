#include "host/scene/triangle.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine {
namespace {

// The sign is the side of the line through both points on which the origin is. Swapped ends give exactly the
// negative.
double edge(const Vec2& from, const Vec2& to) {
  return from.x * to.y - from.y * to.x;
}

}  // namespace

double thickness(const Corners& v) {
  const double size = std::max({magnitude(v[1] - v[0]), magnitude(v[2] - v[1]), magnitude(v[0] - v[2])});
  if (!(size > 0)) return 0;
  return glm::length(glm::cross((v[1] - v[0]) / size, (v[2] - v[0]) / size));
}

Vec3 geometric_normal(const Corners& v) {
  const double size = magnitude(v[1] - v[0]);
  return unit(glm::cross((v[1] - v[0]) / size, (v[2] - v[0]) / size));
}

UvGradients uv_gradients(const Corners& v, const std::array<Vec2, 3>& uv) {
  const Vec3 to_b = v[1] - v[0], to_c = v[2] - v[0], n = cross(to_b, to_c);
  const Vec3 b = cross(to_c, n) / dot(n, n), c = cross(n, to_b) / dot(n, n);
  const Vec2 rise_b = uv[1] - uv[0], rise_c = uv[2] - uv[0];
  return {rise_b.x * b + rise_c.x * c, rise_b.y * b + rise_c.y * c};
}

std::pair<Vec3, Vec3> along_uv(const Corners& v, const std::array<Vec2, 3>& uv) {
  const Vec3 to_b = v[1] - v[0], to_c = v[2] - v[0];
  const Vec2 b = uv[1] - uv[0], c = uv[2] - uv[0];
  const double area = b.x * c.y - b.y * c.x;
  if (area == 0) return {Vec3(0), Vec3(0)};
  return {(c.y * to_b - b.y * to_c) / area, (b.x * to_c - c.x * to_b) / area};
}

void set_smooth(SurfacePoint& point, const Corners& corners, const Corners& normals,
                const std::array<double, 3>& weights) {
  Vec3 flat(0), across(0);
  for (size_t i = 0; i < 3; ++i) {
    flat += weights[i] * corners[i];
    across += weights[i] * normals[i];
  }
  point.lift = Vec2(0);
  for (size_t i = 0; i < 3; ++i) {
    const double height = weights[i] * glm::dot(flat - corners[i], normals[i]) / glm::length(across);
    (height < 0 ? point.lift.x : point.lift.y) += std::abs(height);
  }
  point.normal = unit(across);
}

void set_edges(SurfacePoint& point, const Corners& corners, const Intersection& hit) {
  point.edges = {corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
  point.weights = {1 - hit.u - hit.v, hit.u, hit.v};
}

CornerNormals::CornerNormals(const Affine& map)
    : keeps_angles_(similarity(map.matrix()).has_value()), linear_(map.cotangent) {
  if (!keeps_angles_)
    linear_ /= std::max({magnitude(linear_[0]), magnitude(linear_[1]), magnitude(linear_[2])});
}

std::optional<Intersection> intersect_triangle(const Corners& corners, const Vec3& normal, const Ray& ray) {
  // Shear the corners along the ray into the plane across its main axis z.
  const Vec3 size = glm::abs(ray.d);
  const int z = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
  const int x = (z + 1) % 3;
  const int y = (z + 2) % 3;
  std::array<Vec2, 3> p;
  for (size_t i = 0; i < 3; ++i) {
    const Vec3 from_eye = corners[i] - ray.o;
    p[i] = {from_eye[x] - ray.d[x] / ray.d[z] * from_eye[z], from_eye[y] - ray.d[y] / ray.d[z] * from_eye[z]};
  }

  // Compute on which side of each edge the ray passes.
  const double w0 = edge(p[1], p[2]);
  const double w1 = edge(p[2], p[0]);
  const double w2 = edge(p[0], p[1]);
  if ((w0 < 0 || w1 < 0 || w2 < 0) && (w0 > 0 || w1 > 0 || w2 > 0)) return std::nullopt;
  const double area = w0 + w1 + w2;
  if (area == 0) return std::nullopt;

  // Compute t from the plane: it is the same to the last bit for all triangles in one axis-aligned plane.
  const double t = glm::dot(normal, corners[0] - ray.o) / glm::dot(normal, ray.d);
  if (!(t > 0) || !std::isfinite(t)) return std::nullopt;
  return Intersection{t, w1 / area, w2 / area};
}

}  // namespace eyeray::engine
