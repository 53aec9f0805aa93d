#include <numbers>

#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

// Two squares that share an edge along y, the second turned up by `degrees`; each corner is a separate
// vertex.
std::string hinge(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return fmt::format(
      "v -1 0 0\nv 0 0 0\nv 0 1 0\nv -1 1 0\nv 0 0 0\nv {0} 0 {1}\nv {0} 1 {1}\nv -0 1 0\nf 1 2 3 4\nf 5 6 7 "
      "8\n",
      std::cos(angle), std::sin(angle));
}

size_t bent_normals(const Mesh& mesh) {
  return size_t(
      std::ranges::count_if(mesh.normals, [](const Vec3& n) { return n.x < -1e-6 && n.z < 1 - 1e-6; }));
}

}  // namespace

TEST_CASE("faces that join at a small angle are one surface") {
  // Vertices at equal positions count as one: the hinge has eight vertices, two of them twice, once with −0.
  const Mesh smooth = import_sound(hinge(30), "a.obj").meshes[0];
  CHECK(smooth.positions.size() == 8);
  const double half = 15 * std::numbers::pi / 180;
  size_t at_hinge = 0;
  for (size_t i = 0; i < smooth.positions.size(); ++i) {
    if (smooth.positions[i].x != 0) continue;
    CHECK(glm::length(smooth.normals[i] - Vec3(-std::sin(half), 0, std::cos(half))) < 1e-6);
    ++at_hinge;
  }
  CHECK(at_hinge == 4);
  CHECK(bent_normals(import_sound(hinge(30), "a.obj", {.smooth = 29.0}).meshes[0]) ==
        4);  // those of the turned square
  const Mesh sharp = import_sound(hinge(50), "a.obj").meshes[0];
  for (const auto& t : sharp.triangles) CHECK(sharp.normals[t[0]] == sharp.normals[t[2]]);
  CHECK(import_sound(hinge(30), "a.obj", {.smooth = 0.0}).meshes[0].normals.empty());
}

TEST_CASE("normals weigh faces by their angle, not by how they are cut") {
  // The corner of a cube, one of whose sides is cut in eight there: the normal is the diagonal all the same.
  std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n";
  for (int i = 1; i < 8; ++i) {
    const double angle = std::numbers::pi / 2 * i / 8;
    obj += fmt::format("v {} {} 0\n", std::cos(angle), std::sin(angle));
  }
  obj += "f 1 4 3\nf 1 2 4\nf 1 5 2\n";
  for (int i = 1; i < 7; ++i) obj += fmt::format("f 1 {} {}\n", 5 + i, 4 + i);
  obj += "f 1 3 11\n";
  const Mesh mesh = import_sound(obj, "a.obj", {.smooth = 100.0}).meshes[0];
  size_t corners = 0;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    if (mesh.positions[i] != Vec3(0)) continue;
    CHECK(glm::length(mesh.normals[i] - glm::normalize(Vec3(-1))) < 1e-6);
    ++corners;
  }
  CHECK(corners == 1);
}

TEST_CASE("50 000 faces around a point take little time") {
  std::string obj = "v 0 0 1\n";
  constexpr int count = 50000;
  for (int i = 0; i < count; ++i)
    obj += fmt::format("v {} {} {}\n", std::cos(i * 0.7), std::sin(i * 0.7), i % 7);
  for (int i = 0; i < count; ++i) obj += fmt::format("f 1 {} {}\n", 2 + i, 2 + (i + 1) % count);
  CHECK(import_sound(obj, "a.obj").meshes[0].triangles.size() == count);
}
