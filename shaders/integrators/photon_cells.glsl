// The grid of photons: space is cut into cubes as wide as the disk on which photons are gathered, so that a disk overlaps eight at
// most.
#ifndef PHOTON_CELLS_GLSL
#define PHOTON_CELLS_GLSL
#include "math/math.glsl"
#include "math/rng.glsl"

SHADER_BEGIN

#define MOST_CELLS 8388608.0f  // from the eye along an axis; points farther away are in none

// The cell of a point given in units of cells, relative to the eye.
vec3 cell_of(vec3 cell_position) { return vec3(floor(cell_position.x), floor(cell_position.y), floor(cell_position.z)); }

bool in_cells(vec3 cell_position) { return max_component(abs3(cell_position)) < MOST_CELLS; }

// The key of a cell. Cells far apart may share one.
uint cell_key(vec3 cell, uint mask) {
  return pcg_hash(uint(int(cell.x)) + pcg_hash(uint(int(cell.y)) + pcg_hash(uint(int(cell.z))))) & mask;
}

SHADER_END
#endif
