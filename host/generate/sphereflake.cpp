#include "host/generate/sphereflake.hpp"

#include <array>
#include <cmath>

#include "host/core/error.hpp"
#include "host/generate/batch_text.hpp"
#include "host/generate/classic.hpp"
#include "host/generate/octasphere.hpp"

namespace eyeray::engine::generate {
namespace {

// The directions from a sphere to its nine children, if the sphere's own direction is +z.
std::array<Vec3, 9> child_directions() {
  const double cos15 = (std::sqrt(6.0) + std::sqrt(2.0)) / 4, sin15 = (std::sqrt(6.0) - std::sqrt(2.0)) / 4;
  const Vec3 first[3] = {Vec3(1, 1, 2) / std::sqrt(6.0), {cos15, sin15, 0}, {sin15, cos15, 0}};
  std::array<Vec3, 9> directions;
  for (int k = 0; k < 3; ++k) {  // a third of a turn about z each
    const double c = k == 0 ? 1 : -0.5, s = k == 0 ? 0 : (k == 1 ? 0.5 : -0.5) * std::sqrt(3.0);
    for (int m = 0; m < 3; ++m) {
      const Vec3& e = first[m];
      directions[size_t(3 * k + m)] = {c * e.x - s * e.y, s * e.x + c * e.y, e.z};
    }
  }
  return directions;
}

// v, turned the shortest way that takes +z to the unit vector d.
Vec3 turned(const Vec3& v, const Vec3& d) {
  // The limits are part of the scene: some directions lie within them without being on the axis.
  if (d.z >= 0.9999) return v;
  if (d.z <= -0.9999) return {-v.x, v.y, -v.z};
  const double sine = std::sqrt(d.x * d.x + d.y * d.y);
  const Vec3 axis = Vec3(-d.y, d.x, 0) / sine;
  return v * d.z + glm::cross(axis, v) * sine + axis * (glm::dot(axis, v) * (1 - d.z));
}

struct Grower {
  const std::array<Vec3, 9> directions = child_directions();
  const std::function<void(const Ball&)>& visit;

  void grow(const Ball& ball, const Vec3& direction, int levels) const {
    visit(ball);
    if (levels == 0) return;
    for (const Vec3& d : directions) {
      const Vec3 q = turned(d, direction);
      grow({ball.center + (4 * ball.radius / 3) * q, ball.radius / 3}, q, levels - 1);
    }
  }
};

}  // namespace

uint64_t sphereflake_count(int size_factor) {
  uint64_t power = 9;
  for (int i = 0; i < size_factor; ++i) power *= 9;
  return (power - 1) / 8;
}

void for_each_ball(int size_factor, const std::function<void(const Ball&)>& visit) {
  CHECK_LE(size_factor, max_sphereflake);
  Grower{.visit = visit}.grow({Vec3(0.0), 0.5}, {0, 0, 1}, size_factor);
}

std::string sphereflake_stage() {
  return classic_stage(
             {.eye = {2.1, 1.3, 1.7}, .target = {0, 0, 0}, .lights = {{4, 3, 2}, {1, -4, 4}, {-3, 1, 5}}}) +
         classic_material({.name = "floor", .color = {1, 0.75, 0.33}, .diffuse = 0.8}) +
         classic_material({.name = "ball",
                           .color = {1, 0.9, 0.7},
                           .diffuse = 0.5,
                           .reflectance = 0.5,
                           .specular = 0.5,
                           .ambient = 0}) +
         classic_square("floor", {{{12, 12, -0.5}, {-12, 12, -0.5}, {-12, -12, -0.5}, {12, -12, -0.5}}});
}

std::string sphereflake_spheres(int size_factor) {
  BatchText spheres("sphere", "material = \"ball\"\n", {"center", "radius"});
  for_each_ball(size_factor, [&](const Ball& ball) { spheres.add(ball.center, ball.radius); });
  return spheres.text();
}

void sphereflake_mesh(int size_factor, int divisions, MeshSink& sink) {
  const Mesh unit = octasphere(divisions);
  const uint64_t balls = sphereflake_count(size_factor);
  sink.begin(balls * unit.positions.size(), sphereflake_triangles(size_factor, divisions));
  for_each_ball(size_factor, [&](const Ball& ball) {
    for (const Vec3& n : unit.positions) sink.vertex(ball.center + ball.radius * n, n);
  });
  for (uint64_t i = 0; i < balls; ++i) {
    const uint32_t base = uint32_t(i * unit.positions.size());
    for (const auto& [a, b, c] : unit.triangles) sink.triangle(base + a, base + b, base + c);
  }
}

uint64_t sphereflake_triangles(int size_factor, int divisions) {
  return sphereflake_count(size_factor) * 8 * uint64_t(divisions) * uint64_t(divisions);
}

int sphereflake_divisions(int size_factor, uint64_t triangles) {
  const double squared = double(triangles) / double(sphereflake_triangles(size_factor, 1));
  return std::max(1, int(std::lround(std::sqrt(squared))));
}

}  // namespace eyeray::engine::generate
