#include "classics.hpp"

namespace eyeray::engine::classics {
namespace {

constexpr Vec3 corners[4] = {{-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}, {1, 1, 1}};
constexpr uint32_t faces[4][3] = {{0, 1, 2}, {3, 2, 1}, {2, 3, 0}, {1, 0, 3}};

void grow(const Vec3& center, double size, int levels, Mesh& mesh) {
  for (const Vec3& corner : corners) {
    if (levels > 1) {
      grow(center + size / 2 * corner, size / 2, levels - 1, mesh);
    } else {
      mesh.positions.push_back(center + size * corner);
    }
  }
}

std::string scene(int) {
  return classic_stage({.eye = {1.022846, -3.177154, -2.174512},
                        .target = {-0.004103, -0.004103, 0.216539},
                        .up = {-0.816497, -0.816497, 0.816497},
                        .lights = {{2, -18, -5}}}) +
         classic_material({.name = "tetra", .color = {1, 0.2, 0.2}});
}

// 4ⁿ triangles; coordinates are dyadic, hence exact in float32 too.
Mesh mesh(int size_factor) {
  Mesh mesh;
  grow(Vec3(0.0), 1, size_factor, mesh);
  for (uint32_t first = 0; first < mesh.positions.size(); first += 4)
    for (const auto& [a, b, c] : faces) mesh.triangles.push_back({first + a, first + b, first + c});
  return mesh;
}

}  // namespace

const Classic tetra_classic = {
    .name = "tetra",
    .size_factor = 6,
    .shapes = [](int) { return uint64_t{0}; },
    .scene = scene,
    .mesh = mesh,
    .mesh_material = "tetra",
};

}  // namespace eyeray::engine::classics
