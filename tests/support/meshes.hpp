// Meshes, built in code.
#pragma once

#include <cmath>
#include <numbers>

#include "host/scene/affine.hpp"
#include "host/scene/triangle.hpp"
#include "tests/support/scenes.hpp"

namespace eyeray::engine::test {

inline int add(Scene& scene, Mesh mesh) {
  scene.meshes.push_back(std::move(mesh));
  return int(scene.meshes.size()) - 1;
}

inline void add_instance(Scene& scene, int mesh, int material, const Mat4& transform = Mat4(1.0)) {
  scene.instances.push_back({mesh, transform, material, {}});
}

inline Mesh make_mesh(std::vector<Vec3> positions, std::vector<std::array<uint32_t, 3>> triangles) {
  return {"", std::move(positions), std::move(triangles), {}, {}, {}};
}

// The cube [−1, 1]³: 8 vertices, 12 triangles, outward.
inline Mesh cube() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  for (const auto& [a, b, c, d] : {std::array{0u, 4u, 6u, 2u},
                                   {1u, 3u, 7u, 5u},
                                   {0u, 1u, 5u, 4u},
                                   {2u, 6u, 7u, 3u},
                                   {0u, 2u, 3u, 1u},
                                   {4u, 5u, 7u, 6u}}) {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }
  return mesh;
}

// A sphere of radius 1 by longitude and latitude, outward, with its normals and its uv; needles at the poles.
inline Mesh globe(uint32_t columns, uint32_t rows) {
  Mesh mesh;
  for (uint32_t row = 0; row <= rows; ++row) {
    for (uint32_t column = 0; column <= columns; ++column) {
      // Vertices at the seam and at the poles coincide to the last bit, so the mesh is closed.
      const double longitude = 2 * std::numbers::pi * (column % columns) / columns;
      const double latitude = std::numbers::pi * row / rows;
      const double radius = row == 0 || row == rows ? 0 : std::sin(latitude);
      mesh.positions.emplace_back(radius * std::cos(longitude), -std::cos(latitude),
                                  -radius * std::sin(longitude));
      mesh.normals.push_back(glm::normalize(mesh.positions.back()));
      mesh.uv.emplace_back(double(column) / columns, double(row) / rows);
    }
  }
  for (uint32_t row = 0; row < rows; ++row) {
    for (uint32_t column = 0; column < columns; ++column) {
      const uint32_t a = row * (columns + 1) + column;
      const uint32_t above = a + columns + 1;
      if (row > 0) mesh.triangles.push_back({a, a + 1, above + 1});
      if (row + 1 < rows) mesh.triangles.push_back({a, above + 1, above});
    }
  }
  return mesh;
}

// A terrain over [0, 1]², z up to 0.1, of 2 · side² triangles.
inline Mesh terrain(uint32_t side) {
  Mesh mesh;
  for (uint32_t y = 0; y <= side; ++y)
    for (uint32_t x = 0; x <= side; ++x) {
      const Vec2 p = Vec2(x, y) / double(side);
      mesh.positions.emplace_back(
          p, 0.05 * std::sin(20 * p.x) * std::cos(23 * p.y) + 0.002 * std::sin(700 * p.x + 900 * p.y));
    }
  for (uint32_t y = 0; y < side; ++y)
    for (uint32_t x = 0; x < side; ++x) {
      const uint32_t a = y * (side + 1) + x;
      mesh.triangles.push_back({a, a + 1, a + side + 2});
      mesh.triangles.push_back({a, a + side + 2, a + side + 1});
    }
  return mesh;
}

inline Corners corners(const Mesh& mesh, size_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  return {mesh.positions[a], mesh.positions[b], mesh.positions[c]};
}

// Adds the mesh as separate triangles, like [[triangle]] tables in a file.
inline void add_triangles(Scene& scene, const Mesh& mesh, int material, const Mat4& transform = Mat4(1.0)) {
  const auto three = [](const auto& values, const std::array<uint32_t, 3>& at) {
    return std::array{values[at[0]], values[at[1]], values[at[2]]};
  };
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    shapes::TriangleValues values{.vertices = corners(mesh, i)};
    if (!mesh.normals.empty()) values.normals = three(mesh.normals, mesh.triangles[i]);
    if (!mesh.uv.empty()) values.uv = three(mesh.uv, mesh.triangles[i]);
    add(scene, shapes::make_triangle(values, transform), material);
  }
}

inline Mat4 translation(const Vec3& v) {
  return glm::translate(Mat4(1.0), v);
}

// A map that turns, stretches, shears and moves, and sometimes mirrors.
inline Mat4 random_map(Dice& dice, double strongest, double reach) {
  Mat4 map = translation(dice.in_box(reach));
  for (int i = 0; i < 2; ++i) {
    map = glm::rotate(map, dice.between(0, 7), dice.direction());
    const auto factor = [&] { return dice.scale(-strongest, strongest) * (dice.between(0, 4) < 1 ? -1 : 1); };
    map = glm::scale(map, {factor(), factor(), factor()});
  }
  return map;
}

}  // namespace eyeray::engine::test
