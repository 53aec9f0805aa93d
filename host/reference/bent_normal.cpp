#include "host/reference/bent_normal.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "host/reference/emitter_sample.hpp"
#include "host/scene/luminance.hpp"

namespace eyeray::engine::reference {
namespace {

constexpr double least_upright = 0.01;
constexpr double least_mirrored = 0.001;

bool usable(const Vec3& v) {
  const double squared = glm::dot(v, v);
  return squared > 1e-30 && squared < 1e30;
}

// The directions of the u and v that a map reads, perpendicular to n and to each other, and the map's value.
struct TangentSpace {
  Vec3 t, b;
  Vec3 code;
};

// `map`: null for a constant direction along u.
TangentSpace tangent_space(const Texture* map, const SurfacePoint& point, const Vec3& n) {
  const bool second = point.second && map && map->reads_second_uv();
  const auto uv =
      second ? *point.second : SurfacePoint::SecondUv{point.uv, point.along_u, point.along_v, point.tangent};
  const bool own = uv.tangent.w != 0;
  const Vec3 along_u = own ? Vec3(uv.tangent) : uv.along_u;
  Vec3 t = along_u - n * glm::dot(n, along_u);
  t = usable(t) ? glm::normalize(t) : Vec3(0);
  const double turn =
      own ? uv.tangent.w : glm::dot(glm::cross(point.normal_geometric, uv.along_u), uv.along_v);
  const Vec3 b = glm::cross(n, t) * (turn < 0 ? -1.0 : 1.0);
  const Vec3 code = map ? 2.0 * map->at({uv.uv, uv.uv, point.position}) - 1.0 : Vec3(1, 0, 0);
  return {t, b, code};
}

Vec3 mapped(const NormalMap& map, const SurfacePoint& point, const Vec3& n) {
  const auto [t, b, code] = tangent_space(map.texture.get(), point, n);
  const Vec3 bent = map.scale * (code.x * t + code.y * b) + code.z * n;
  return usable(bent) ? glm::normalize(bent) : n;
}

// The slope of the height of `map`, from one side of the point to the other.
double rise(const BumpMap& map, const TextureContext& from, const TextureContext& to) {
  return map.height * (luminance(map.texture->at(to)) - luminance(map.texture->at(from))) / (2 * map.width);
}

Vec3 bumped(const BumpMap& map, const SurfacePoint& point, const Vec3& n) {
  if (map.texture->in_space()) {
    const auto [s, t] = tangents(n);
    const auto along = [&](const Vec3& d) {
      return rise(map, {point.uv, point.position - map.width * d},
                  {point.uv, point.position + map.width * d});
    };
    return glm::normalize(n - along(s) * s - along(t) * t);
  }
  const auto along = [&](const Vec2& d) {
    return rise(map, {point.uv - map.width * d, point.position}, {point.uv + map.width * d, point.position});
  };
  // Blinn's n + (h_u n × p_v − h_v n × p_u) / |p_u × p_v|, where n in the products is the normal of the
  // surface that u and v span.
  const Vec3 across = glm::cross(point.along_u, point.along_v);
  const double area = glm::length(across);
  if (!(area > 0 && std::isfinite(area))) return n;
  const Vec3 flat = across / area;
  const Vec3 slope =
      -(along({1, 0}) * glm::cross(flat, point.along_v) - along({0, 1}) * glm::cross(flat, point.along_u)) /
      area;
  const Vec3 bent = n - (slope - n * glm::dot(n, slope));
  return usable(bent) ? glm::normalize(bent) : n;
}

// Bends n back until the mirrored view is above the surface, on the viewer's side. A normal below the horizon
// is first raised above it. If the mirrored view is then too low, n becomes the direction half way between
// the viewer and a mirrored view just above the horizon.
Vec3 lifted(Vec3 n, const SurfacePoint& point, const Vec3& d) {
  const Vec3 to_viewer = -glm::normalize(d);
  const double side = glm::dot(to_viewer, point.normal_geometric) > 0 ? 1 : -1;
  const Vec3 up = side * point.normal_geometric;
  n *= side;
  if (const double upright = glm::dot(n, up); upright < least_upright)
    n = glm::normalize(n + (least_upright - upright) * up);
  const double height = std::min(least_mirrored, 0.5 * glm::dot(to_viewer, up));
  const Vec3 mirrored = 2 * glm::dot(to_viewer, n) * n - to_viewer;
  if (const double above = glm::dot(mirrored, up); above < height)
    n = glm::normalize(to_viewer + glm::normalize(mirrored + (height - above) / glm::dot(n, up) * n));
  return side * n;
}

}  // namespace

namespace {

Vec3 rough_axis(const RoughAxis& axis, const SurfacePoint& point) {
  const auto [t, b, code] = tangent_space(axis.texture.get(), point, point.normal);
  // The map's direction as a complex number, rotated.
  const std::complex<double> turned = std::complex(code.x, code.y) * std::polar(1.0, axis.turn);
  const Vec3 along = turned.real() * t + turned.imag() * b;
  return usable(along) ? glm::normalize(along) : Vec3(0);
}

}  // namespace

void bend_normals(const Material& material, SurfacePoint& point, const Vec3& d) {
  const Vec3 own = point.normal;
  point.coat_normal =
      material.coat_normal_map ? lifted(mapped(*material.coat_normal_map, point, own), point, d) : own;
  Vec3 n = own;
  if (material.normal_map) n = mapped(*material.normal_map, point, n);
  if (material.bump_map) n = bumped(*material.bump_map, point, n);
  if (material.normal_map || material.bump_map) point.normal = lifted(n, point, d);
  if (material.rough_axis) point.rough_axis = rough_axis(*material.rough_axis, point);
}

}  // namespace eyeray::engine::reference
