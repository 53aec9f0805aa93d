#include "host/scene/emitter_form.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/error.hpp"

namespace eyeray::engine {

namespace {

// The emitter form of a QuadricForm that is a sphere or a cylinder in object space.
std::optional<EmitterForm> quadric_form(const QuadricForm& it) {
  if (it.product != Vec3(0) || it.linear != Vec3(0) || it.constant != -1) return std::nullopt;
  const Vec2 low(it.clip.min.x, it.clip.min.z), high(it.clip.max.x, it.clip.max.z);
  if (glm::any(glm::greaterThan(low, Vec2(-1))) || glm::any(glm::lessThan(high, Vec2(1))))
    return std::nullopt;
  if (it.square == Vec3(1) && !it.open && it.clip.min.y <= -1 && it.clip.max.y >= 1)
    return EllipsoidForm{it.to_world};
  if (it.square == Vec3(1, 0, 1) && it.clip.min.y == -1 && it.clip.max.y == 1)
    return CylinderForm{it.to_world, it.open};
  return std::nullopt;
}

std::optional<EmitterForm> polygon_form(const PolygonForm& polygon) {
  if (polygon.outlines.size() != 1 || polygon.outlines[0].size() != 4) return std::nullopt;
  const auto& corners = polygon.outlines[0];
  const Vec3 u = corners[1] - corners[0], v = corners[3] - corners[0];
  const double gap = glm::length(corners[2] - corners[0] - u - v);
  if (gap > 1e-12 * (glm::length(u) + glm::length(v))) return std::nullopt;
  return ParallelogramForm{corners[0], u, v};
}

// The area of the side: 2 ∫ |∂p/∂φ × ∂p/∂y| dφ. The midpoint rule is exact for smooth periodic functions.
double side_area(const CylinderForm& cylinder) {
  constexpr int steps = 256;
  const Mat3 linear(cylinder.to_world);
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double angle = 2 * M_PI * (i + 0.5) / steps;
    sum += glm::length(glm::cross(linear * Vec3(-std::sin(angle), 0, std::cos(angle)), linear[1]));
  }
  return 2 * sum * 2 * M_PI / steps;
}

double cap_area(const CylinderForm& cylinder) {
  const Mat3 linear(cylinder.to_world);
  return cylinder.open ? 0 : M_PI * glm::length(glm::cross(linear[0], linear[2]));
}

// The area of an ellipsoid, ∫ |M⁻ᵀ n| |det M| dω, on a grid that is uniform in height and azimuth.
double ellipsoid_area(const Mat3& linear) {
  constexpr int rows = 64;
  const Mat3 cofactors = glm::transpose(glm::inverse(linear)) * glm::determinant(linear);
  double sum = 0;
  for (int i = 0; i < rows; ++i)
    for (int k = 0; k < 2 * rows; ++k) {
      const double y = -1 + 2 * (i + 0.5) / rows, turn = M_PI * (k + 0.5) / rows, r = std::sqrt(1 - y * y);
      sum += glm::length(cofactors * Vec3(r * std::cos(turn), y, r * std::sin(turn)));
    }
  return 4 * M_PI * sum / (2.0 * rows * rows);
}

struct Area {
  double operator()(const SphereForm& sphere) const { return 4 * M_PI * sphere.radius * sphere.radius; }
  double operator()(const DiskForm& disk) const {
    const Vec3 u(disk.to_world[0]), v(disk.to_world[2]);
    return M_PI * (1 - disk.inner * disk.inner) * glm::length(glm::cross(u, v));
  }
  double operator()(const TriangleForm& triangle) const {
    const auto& [a, b, c] = triangle.vertices;
    return glm::length(glm::cross(b - a, c - a)) / 2;
  }
  double operator()(const ParallelogramForm& it) const {
    return glm::length(glm::cross(it.edge_u, it.edge_v));
  }
  double operator()(const BoxForm& box) const {
    const Mat3 m(box.to_world);
    return 8 * (glm::length(glm::cross(m[0], m[1])) + glm::length(glm::cross(m[1], m[2])) +
                glm::length(glm::cross(m[2], m[0])));
  }
  double operator()(const EllipsoidForm& it) const { return ellipsoid_area(Mat3(it.to_world)); }
  double operator()(const CylinderForm& it) const { return side_area(it) + 2 * cap_area(it); }
};

struct Bounding {
  // The bounds of a form that lies around its middle.
  static LightBounds around(const Mat4& to_world, double radius) {
    return {.center = Vec3(to_world[3]), .radius = radius};
  }
  static double stretch(const Mat3& linear) {
    return std::sqrt(glm::dot(linear[0], linear[0]) + glm::dot(linear[1], linear[1]) +
                     glm::dot(linear[2], linear[2]));
  }
  static LightBounds flat(std::initializer_list<Vec3> corners, const Vec3& normal) {
    LightBounds bounds{.axis = unit(normal), .spread = 0, .both_sides = true};
    for (const Vec3& corner : corners) bounds.center += corner / double(corners.size());
    for (const Vec3& corner : corners)
      bounds.radius = std::max(bounds.radius, glm::length(corner - bounds.center));
    return bounds;
  }

  LightBounds operator()(const SphereForm& sphere) const {
    return {.center = sphere.center, .radius = sphere.radius};
  }
  LightBounds operator()(const DiskForm& disk) const {
    const Vec3 u(disk.to_world[0]), v(disk.to_world[2]);
    LightBounds bounds = flat({Vec3(disk.to_world[3])}, glm::cross(u, v));
    bounds.radius = std::hypot(glm::length(u), glm::length(v));
    return bounds;
  }
  LightBounds operator()(const TriangleForm& triangle) const {
    const auto& [a, b, c] = triangle.vertices;
    return flat({a, b, c}, glm::cross(b - a, c - a));
  }
  LightBounds operator()(const ParallelogramForm& it) const {
    return flat({it.corner, it.corner + it.edge_u, it.corner + it.edge_v, it.corner + it.edge_u + it.edge_v},
                glm::cross(it.edge_u, it.edge_v));
  }
  LightBounds operator()(const BoxForm& it) const {
    const Mat3 m(it.to_world);
    return around(it.to_world, glm::length(m[0]) + glm::length(m[1]) + glm::length(m[2]));
  }
  LightBounds operator()(const EllipsoidForm& it) const {
    return around(it.to_world, stretch(Mat3(it.to_world)));
  }
  LightBounds operator()(const CylinderForm& it) const {
    const Mat3 m(it.to_world);
    return around(it.to_world, glm::length(m[1]) + std::hypot(glm::length(m[0]), glm::length(m[2])));
  }
};

struct Mapping {
  const Affine& map;

  EmitterForm operator()(const SphereForm& it) const {
    if (const auto similar = similarity(map.matrix()))
      return SphereForm{similar->point(it.center), it.radius * similar->scale, similar->axes * it.axes};
    const Mat3 linear = it.axes * it.radius;
    return EllipsoidForm{map.matrix() * Mat4{{linear[0], 0}, {linear[1], 0}, {linear[2], 0}, {it.center, 1}}};
  }
  EmitterForm operator()(const DiskForm& it) const { return DiskForm{map.matrix() * it.to_world, it.inner}; }
  EmitterForm operator()(const TriangleForm& it) const {
    return TriangleForm{{map.point(it.vertices[0]), map.point(it.vertices[1]), map.point(it.vertices[2])}};
  }
  EmitterForm operator()(const ParallelogramForm& it) const {
    return ParallelogramForm{map.point(it.corner), map.linear * it.edge_u, map.linear * it.edge_v};
  }
  EmitterForm operator()(const BoxForm& it) const { return BoxForm{map.matrix() * it.to_world}; }
  EmitterForm operator()(const EllipsoidForm& it) const { return EllipsoidForm{map.matrix() * it.to_world}; }
  EmitterForm operator()(const CylinderForm& it) const {
    return CylinderForm{map.matrix() * it.to_world, it.open};
  }
};

}  // namespace

std::optional<EmitterForm> emitter_form(const ShapeForm& form) {
  if (const auto* sphere = std::get_if<SphereForm>(&form)) return *sphere;
  if (const auto* disk = std::get_if<DiskForm>(&form)) return *disk;
  if (const auto* triangle = std::get_if<TriangleForm>(&form)) return *triangle;
  if (const auto* box = std::get_if<BoxForm>(&form)) return *box;
  if (const auto* quadric = std::get_if<QuadricForm>(&form)) return quadric_form(*quadric);
  if (const auto* polygon = std::get_if<PolygonForm>(&form)) return polygon_form(*polygon);
  return std::nullopt;
}

EmitterForm mapped(const EmitterForm& form, const Affine& map) {
  return std::visit(Mapping{map}, form);
}

double area_of(const EmitterForm& form) {
  return std::visit(Area(), form);
}

bool is_rectangle(const ParallelogramForm& it) {
  return std::abs(glm::dot(it.edge_u, it.edge_v)) <= 1e-7 * glm::length(it.edge_u) * glm::length(it.edge_v);
}

double share_of_side(const CylinderForm& cylinder) {
  return side_area(cylinder) / area_of(cylinder);
}

LightBounds bounds_of(const EmitterForm& form) {
  return std::visit(Bounding(), form);
}

bool is_flat(const EmitterForm& form) {
  return std::holds_alternative<DiskForm>(form) || std::holds_alternative<TriangleForm>(form) ||
         std::holds_alternative<ParallelogramForm>(form);
}

Vec3 normal_of(const EmitterForm& form) {
  CHECK(is_flat(form));
  return bounds_of(form).axis;
}

Vec3 point_of(const EmitterForm& form) {
  const auto* disk = std::get_if<DiskForm>(&form);
  // A point that is not in the disk's hole.
  return disk ? Vec3(disk->to_world[3]) + (1 + disk->inner) / 2 * Vec3(disk->to_world[0])
              : bounds_of(form).center;
}

}  // namespace eyeray::engine
