#include "host/generate/terrain.hpp"

#include "host/generate/noise.hpp"
#include "host/loader/scene_file.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::loader;
using namespace eyeray::engine::generate;

namespace {

Mesh terrain(const TerrainOptions& options) {
  MeshInMemory sink;
  terrain_mesh(options, sink);
  return std::move(sink.mesh);
}

}  // namespace

TEST_CASE("noise is bounded, and its gradient is the derivative") {
  double least = 1, most = -1;
  for (int i = 0; i < 20'000; ++i) {
    const Vec2 p{i * 0.737 - 7000, 4000 - i * 0.419};
    const Noise n = noise(p, 3);
    least = std::min(least, n.value);
    most = std::max(most, n.value);
    const double h = 1e-5;
    const Vec2 difference{noise(p + Vec2(h, 0), 3).value - noise(p - Vec2(h, 0), 3).value,
                          noise(p + Vec2(0, h), 3).value - noise(p - Vec2(0, h), 3).value};
    CHECK(glm::distance(n.gradient, difference / (2 * h)) < 1e-6);
  }
  CHECK(least >= -1);
  CHECK(least < -0.9);
  CHECK(most <= 1);
  CHECK(most > 0.9);
  CHECK(noise({0.5, 0.5}, 1).value != noise({0.5, 0.5}, 2).value);
}

TEST_CASE("a terrain is a grid with two triangles a cell, facing up") {
  CHECK(terrain_grid(51'200) == 160);
  CHECK(terrain_grid(1'048'352) == 724);
  CHECK(terrain_grid(8'000'000) == 2000);
  CHECK(terrain_grid(1) == 1);

  for (const double roughness : {0.2, 0.5, 0.6}) {
    for (const int grid : {1, 2, 63, 64, 65, 300}) {
      const Mesh mesh = terrain({.grid = grid, .roughness = roughness});
      CAPTURE(grid);
      REQUIRE(mesh.positions.size() == size_t((grid + 1) * (grid + 1)));
      REQUIRE(mesh.triangles.size() == size_t(2 * grid * grid));
      CHECK(mesh.positions.front() == Vec3(-5, mesh.positions.front().y, -5));
      CHECK(mesh.positions.back() == Vec3(5, mesh.positions.back().y, 5));
      double area = 0;
      bool upright = true, on_side = true;
      for (const auto& [a, b, c] : mesh.triangles) {
        const Vec3 n =
            glm::cross(mesh.positions[b] - mesh.positions[a], mesh.positions[c] - mesh.positions[a]);
        upright &= n.y > 0;
        area += n.y / 2;
        for (const uint32_t corner : {a, b, c}) on_side &= glm::dot(n, mesh.normals[corner]) > 0;
      }
      CHECK(upright);
      CHECK(on_side);
      CHECK(area == doctest::Approx(100).epsilon(1e-5));
    }
  }
}

TEST_CASE("heights join across the blocks of rows, and normals fit the heights") {
  const TerrainOptions options{.grid = 130, .seed = 5};
  const Mesh mesh = terrain(options);
  for (const int row : {1, 62, 63, 64, 65, 127, 128, 129}) {
    for (int column = 1; column < 130; ++column) {
      const auto at = [&](int r, int c) { return mesh.positions[size_t(r * 131 + c)]; };
      const Vec3 p = at(row, column);
      CHECK(p.y == terrain_height(options, {-5 + 10.0 * column / 130, -5 + 10.0 * row / 130}));
      const Vec3 across = at(row, column + 1) - at(row, column - 1);
      const Vec3 along = at(row + 1, column) - at(row - 1, column);
      CHECK(glm::distance(mesh.normals[size_t(row * 131 + column)],
                          glm::normalize(glm::cross(along, across))) < 1e-5);
    }
  }
}

TEST_CASE("a seed gives the same landscape, finer on a finer grid; another seed gives another") {
  const TerrainOptions coarse{.grid = 256}, fine{.grid = 4096}, other{.grid = 256, .seed = 1};
  double refined = 0, different = 0;
  for (int i = 0; i < 100; ++i) {
    const Vec2 p{-4.9 + 0.098 * i, 4.7 - 0.091 * i};
    refined = std::max(refined, std::abs(terrain_height(coarse, p) - terrain_height(fine, p)));
    different = std::max(different, std::abs(terrain_height(coarse, p) - terrain_height(other, p)));
  }
  CHECK(refined > 0);
  CHECK(refined < 0.05);
  CHECK(different > 0.5);
}

TEST_CASE("a terrain's stage is a scene") {
  const Scene scene = parse_scene(terrain_stage(), "terrain.toml");
  CHECK(scene.lights.size() == 1);
  CHECK(scene.materials.size() == 1);
}
