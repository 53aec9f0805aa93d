#include <algorithm>
#include <cmath>

#include "classics.hpp"

namespace eyeray::engine::classics {
namespace {

// Bernstein's cubic polynomials, and their derivatives.
std::array<double, 4> weights(double t) {
  const double u = 1 - t;
  return {u * u * u, 3 * t * u * u, 3 * t * t * u, t * t * t};
}
std::array<double, 4> slopes(double t) {
  const double u = 1 - t;
  return {-3 * u * u, 3 * u * u - 6 * t * u, 6 * t * u - 3 * t * t, 3 * t * t};
}

Vec3 sum(const BezierPatch& patch, const std::array<double, 4>& along_s,
         const std::array<double, 4>& along_t) {
  Vec3 total(0.0);
  for (size_t r = 0; r < 4; ++r) {
    for (size_t c = 0; c < 4; ++c) total += along_s[r] * along_t[c] * patch[r][c];
  }
  return total;
}

// Patches have no normal where the lid and the bottom come to a point.
bool is_cusp(const Vec3& p) {
  return std::abs(p.x) <= 1e-4 && std::abs(p.y) <= 1e-4;
}

void add_vertex(const BezierPatch& patch, double s, double t, Mesh& mesh) {
  const Vec3 p = sum(patch, weights(s), weights(t));
  const Vec3 along_s = sum(patch, slopes(s), weights(t)), along_t = sum(patch, weights(s), slopes(t));
  mesh.positions.push_back(p);
  mesh.normals.push_back(is_cusp(p) ? Vec3(0, 0, p.z > 1.5 ? 1 : -1)
                                    : glm::normalize(glm::cross(along_t, along_s)));
}

// The chessboard's squares (s, t) whose sum s + t is odd, or those whose sum is even.
std::string squares(int size_factor, bool odd, std::string_view material) {
  BatchText triangles("triangle", fmt::format("material = \"{}\"\n", material), {"vertices"});
  const auto corner = [&](int s, int t) {
    return Vec3(4 * (2.0 * s / size_factor - 1), 4 * (2.0 * t / size_factor - 1), 0);
  };
  for (int s = 0; s < size_factor; ++s) {
    for (int t = 0; t < size_factor; ++t) {
      if (((s + t) % 2 == 1) != odd) continue;
      triangles.add(std::array{corner(s, t), corner(s + 1, t), corner(s + 1, t + 1)});
      triangles.add(std::array{corner(s + 1, t + 1), corner(s, t + 1), corner(s, t)});
    }
  }
  return triangles.text();
}

std::string scene(int size_factor) {
  ClassicSurface square{.name = "white",
                        .color = Vec3(1),
                        .diffuse = 0.5,
                        .reflectance = 0.5,
                        .specular = 0.5,
                        .shininess = ClassicSurface::shine_30};
  std::string text =
      classic_stage(
          {.eye = {4.86, 7.2, 5.4}, .target = {0, 0, 0}, .lights = {{-3.1, 9.8, 12.1}, {11.3, 5.1, 8.8}}}) +
      classic_material(square);
  square.name = "grey";
  square.color = Vec3(0.5);
  return text + classic_material(square) +
         classic_material({.name = "teapot",
                           .color = {1, 0.5, 0.1},
                           .diffuse = 0.75,
                           .reflectance = 0.25,
                           .specular = 0.25}) +
         squares(size_factor, true, "white") + squares(size_factor, false, "grey");
}

// 64 n² − 8 n triangles with normals at their corners. At a cusp, where a patch's first row is one point,
// one of each two triangles is left out.
Mesh mesh(int size_factor) {
  Mesh mesh;
  const uint32_t n = uint32_t(size_factor), side = n + 1;
  const std::vector<BezierPatch> patches = teapot_patches();
  // If all of a patch's first row is one point, its first triangles are missing.
  const auto begins_at_cusp = [](const BezierPatch& patch) {
    return is_cusp(patch[0][0]) && is_cusp(patch[0][3]);
  };

  for (const BezierPatch& patch : patches) {
    for (uint32_t s = 0; s < side; ++s) {
      for (uint32_t t = 0; t < side; ++t) add_vertex(patch, double(s) / n, double(t) / n, mesh);
    }
  }
  for (uint32_t patch = 0; patch < patches.size(); ++patch) {
    for (uint32_t s = 0; s < n; ++s) {
      for (uint32_t t = 0; t < n; ++t) {
        const uint32_t a = (patch * side + s) * side + t, b = a + 1, d = a + side, c = d + 1;
        if (s > 0 || !begins_at_cusp(patches[patch])) mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({c, d, a});
      }
    }
  }
  return mesh;
}

}  // namespace

std::string teapot_bezier() {
  BatchText text("bezier", "material = \"teapot\"\n", {"points"});
  for (const BezierPatch& patch : teapot_patches()) {
    std::array<Vec3, 16> points;
    for (size_t i = 0; i < 16; ++i) points[i] = patch[i / 4][i % 4];
    text.add(points);
  }
  return text.text();
}

const Classic teapot_classic = {
    .name = "teapot",
    .size_factor = 6,
    .shapes = [](int n) { return 2 * uint64_t(n) * uint64_t(n); },
    .scene = scene,
    .mesh = mesh,
    .mesh_material = "teapot",
};

}  // namespace eyeray::engine::classics
