// A fractal landscape over the square from (−5, −5) to (5, 5) of the xz plane, y up.
#pragma once

#include <cstdint>
#include <string>

#include "host/generate/mesh_sink.hpp"

namespace eyeray::engine::generate {

// Cells a side of the largest grid: two triangles a cell.
inline constexpr int max_terrain_grid = 16384;

struct TerrainOptions {
  int grid = 160;  // cells a side
  uint32_t seed = 0;
  double roughness = 0.48;  // the strength of each octave relative to the one before
};

// The height above a point of the plane. A finer grid shows finer octaves of the same landscape.
double terrain_height(const TerrainOptions& options, const Vec2& p);

// (grid + 1)² vertices with smooth normals, row by row; 2 · grid² triangles. Needs memory for a few rows.
void terrain_mesh(const TerrainOptions& options, MeshSink& sink);

// The grid, at least 1, whose number of triangles is nearest to `triangles`.
int terrain_grid(uint64_t triangles);

// The TOML of camera, sun, sky and the material "ground".
std::string terrain_stage();

}  // namespace eyeray::engine::generate
