#include "host/reference/emitter_sample.hpp"

#include <cmath>

namespace eyeray::reference {

namespace {

// A point on the sphere, which is a little larger, is not outside: what it sees is its inside.
bool outside(const SphereForm& sphere, const Vec3& from) {
  const Vec3 way = sphere.center - from;
  return glm::dot(way, way) > 1.0002 * sphere.radius * sphere.radius;
}

// 1 − the cosine of half the angle under which the sphere is seen.
double versine(const SphereForm& sphere, const Vec3& from) {
  const double sine = sphere.radius / glm::length(sphere.center - from);
  return 1 - std::sqrt((1 - sine) * (1 + sine));
}

struct Chooser {
  const Vec3& from;
  const Vec2& u;

  // Wang: Physically Correct Direct Lighting for Distribution Ray Tracing, Graphics Gems III, 1992.
  EmitterSample operator()(const SphereForm& sphere) const {
    const double turn = 2 * M_PI * u.y;
    const bool seen = outside(sphere, from);
    const Vec3 way = sphere.center - from;
    const Vec3 axis = seen ? glm::normalize(way) : Vec3(0, 0, 1);
    const double cosine = 1 - (seen ? u.x * versine(sphere, from) : 2 * u.x);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const auto [s, t] = tangents(axis);
    const Vec3 d = cosine * axis + sine * (std::cos(turn) * s + std::sin(turn) * t);
    if (!seen) return {sphere.center + sphere.radius * d, d};
    const double b = glm::dot(way, d);
    const double c = glm::dot(way, way) - sphere.radius * sphere.radius;
    const double near = b - std::sqrt(std::max(0.0, b * b - c));
    const Vec3 normal = glm::normalize(near * d - way);
    return {sphere.center + sphere.radius * normal, normal};
  }

  EmitterSample operator()(const DiskForm& disk) const {
    const Vec3 x(disk.to_world[0]), z(disk.to_world[2]);
    const Vec2 at = on_disk(u);
    const double r = glm::length(at);
    const double hole = disk.inner * disk.inner;
    const double grow = r == 0 ? 1 : std::sqrt(hole + r * r * (1 - hole)) / r;
    return {Vec3(disk.to_world[3]) + grow * (at.x * x + at.y * z), glm::normalize(glm::cross(x, z))};
  }

  EmitterSample operator()(const TriangleForm& triangle) const {
    const auto& [a, b, c] = triangle.vertices;
    const double root = std::sqrt(u.x);
    return {(1 - root) * a + root * (1 - u.y) * b + root * u.y * c, glm::normalize(glm::cross(b - a, c - a))};
  }

  EmitterSample operator()(const ParallelogramForm& it) const {
    return {it.corner + u.x * it.edge_u + u.y * it.edge_v, glm::normalize(glm::cross(it.edge_u, it.edge_v))};
  }
};

}  // namespace

EmitterSample sample_emitter(const EmitterForm& form, const Vec3& from, const Vec2& u) {
  return std::visit(Chooser{from, u}, form);
}

double emitter_density(const EmitterForm& form, const Vec3& from, const EmitterSample& place) {
  if (const auto* sphere = std::get_if<SphereForm>(&form); sphere && outside(*sphere, from))
    return 1 / (2 * M_PI * versine(*sphere, from));
  const Vec3 way = place.position - from;
  const double distance = glm::length(way);
  return distance * distance * distance / (area_of(form) * std::abs(glm::dot(way, place.normal)));
}

Vec2 on_disk(const Vec2& u) {
  const Vec2 square = 2.0 * u - 1.0;
  if (square == Vec2(0)) return Vec2(0);
  const bool wide = std::abs(square.x) > std::abs(square.y);
  const double radius = wide ? square.x : square.y;
  const double angle = wide ? M_PI / 4 * square.y / square.x : M_PI / 2 - M_PI / 4 * square.x / square.y;
  return radius * Vec2(std::cos(angle), std::sin(angle));
}

std::pair<Vec3, Vec3> tangents(const Vec3& n) {
  // Axes of no symmetry that a sensible scene has.
  const Vec3 axis = glm::normalize(Vec3(0.3141592653589793, 0.8979323846264338, 0.2718281828459045));
  const Vec3 s = glm::normalize(glm::cross(axis, n));
  return {s, glm::cross(n, s)};
}

}  // namespace eyeray::reference
