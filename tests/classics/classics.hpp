// The other scenes of Haines' Standard Procedural Databases (host/generate/classic.hpp), whose numbers of
// rays are published: eyeray is held to them.
#pragma once

#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/generate/batch_text.hpp"
#include "host/generate/classic.hpp"
#include "host/scene/mesh.hpp"

namespace eyeray::engine::classics {

using namespace generate;

// A scene that its name and a size factor determine.
struct Classic {
  std::string_view name;
  int size_factor;              // the factor of the published statistics
  uint64_t (*shapes)(int);      // their number, without the mesh
  std::string (*scene)(int);    // TOML of everything but the mesh
  Mesh (*mesh)(int) = nullptr;  // without normals where it is flat
  std::string_view mesh_material = "";
};

extern const Classic tetra_classic, tree_classic, rings_classic, gears_classic, mount_classic, teapot_classic;
std::span<const Classic> all_classics();
// Writes the scene as scene.toml, and its mesh as mesh.obj.
void write(const Classic& classic, int size_factor, const std::filesystem::path& folder);

// (cos, sin) of the angle.
inline Vec2 unit_circle(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), std::sin(angle)};
}

// ---- tree: a branch bears two shorter ones, each turned its own way ----
// A cone from `foot` to `tip`, and a sphere of `tip_radius` at its tip.
struct Branch {
  Vec3 foot;
  Vec3 tip;
  double radius;
  double tip_radius;
};
// Visits all 2ⁿ⁺¹ − 1 branches, parents before children, depth first.
void for_each_branch(int size_factor, const std::function<void(const Branch&)>& visit);

// ---- rings: pyramids of six rings that interlock, of cylinders and spheres ----
// A cylinder from one point to another, and a sphere of its radius at the first.
struct Rod {
  Vec3 from;
  Vec3 to;
  int ring;  // 0 … 5
};
inline constexpr double rod_radius = 0.07412;
// Visits all 5 n (n + 1) (2 n + 1) rods, from the front layer backwards.
void for_each_rod(int size_factor, const std::function<void(const Rod&)>& visit);

// ---- gears: a block of gears that mesh, some of glass ----
struct Gear {
  Vec3 center;  // center of the gear's top face
  double radius;
  double thickness;
  Vec3 color;
  bool glass;
  std::string material;  // its name; gears of one surface share it
  // Corners of the top face, counter-clockwise from above; the bottom face has the same corners below,
  // clockwise.
  std::array<Vec3, 144> top, bottom;
};
// Visits all n³ gears, layer below layer.
void for_each_gear(int size_factor, const std::function<void(const Gear&)>& visit);

// ---- mount: a fractal mountain below four balls of glass ----
// The seed of a grid point's height, for i, j from 0 to 2ⁿ. Seeds repeat: that is part of the scene.
uint32_t mount_seed(int size_factor, int i, int j);
// A normally distributed number by the polar method, from the package's generator started with `seed`.
double mount_gauss(uint32_t seed);
// Heights of the (2ⁿ + 1)² grid points by midpoint displacement, row after row in order of j. The corners, at
// ±1, have height 0.
std::vector<double> mount_heights(int size_factor);

// ---- teapot: Newell's, of 32 Bézier patches cut into triangles, on a chessboard ----
// 16 control points: s grows from row to row, and t within a row.
using BezierPatch = std::array<std::array<Vec3, 4>, 4>;
// All 32 patches: rim, body, handle, spout, lid, bottom.
std::vector<BezierPatch> teapot_patches();
// The surface itself: 32 [[bezier]] in one table.
std::string teapot_bezier();

}  // namespace eyeray::engine::classics
