#include "generate/sphereflake.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "generate/octasphere.hpp"

namespace eyeray {
namespace {

// The nine directions in which children stand, their parent's own being +z.
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
  // The original's 45° reach from the middle of the first pixel to that of the last, of 512.
  const double fov = 2 * std::atan(std::tan(std::numbers::pi / 8) * 512 / 511) * 180 / std::numbers::pi;
  return fmt::format(R"([image]
width = 512
height = 512

[camera]
eye = [2.1, 1.3, 1.7]
target = [0, 0, 0]
up = [0, 0, 1]
fov = {:.10g}

[render]
max_depth = 4
min_weight = 0
background = [0.078, 0.361, 0.753]
ambient = {:.10g}

)",
                     fov, std::sqrt(3.0) / 6) +
         fmt::format(R"([[light]]
type = "point"
falloff = "none"
position = [4, 3, 2]
intensity = {0:.10g}

[[light]]
type = "point"
falloff = "none"
position = [1, -4, 4]
intensity = {0:.10g}

[[light]]
type = "point"
falloff = "none"
position = [-3, 1, 5]
intensity = {0:.10g}
)",
                     1 / std::sqrt(3.0)) +
         R"(
[[material]]
name = "floor"
type = "phong"
diffuse = [0.8, 0.6, 0.264]
ambient = [0.2, 0.15, 0.066]

[[material]]
name = "ball"
type = "phong"
diffuse = [0.5, 0.45, 0.35]
ambient = 0
reflectance = 0.5
specular = 0.5
shininess = 3.0827007755568205

[[triangle]]
vertices = [[12, 12, -0.5], [-12, 12, -0.5], [-12, -12, -0.5]]
material = "floor"

[[triangle]]
vertices = [[-12, -12, -0.5], [12, -12, -0.5], [12, 12, -0.5]]
material = "floor"
)";
}

std::string sphereflake_spheres(int size_factor) {
  std::string centers, radii;
  for_each_ball(size_factor, [&](const Ball& ball) {
    fmt::format_to(std::back_inserter(centers), "[{},{},{}],\n", ball.center.x, ball.center.y, ball.center.z);
    fmt::format_to(std::back_inserter(radii), "{},\n", ball.radius);
  });
  return fmt::format("\n[[sphere]]\nmaterial = \"ball\"\nbatch = {{ center = [\n{}], radius = [\n{}] }}\n",
                     centers, radii);
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

}  // namespace eyeray
