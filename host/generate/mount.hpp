// "mount" of Haines' databases: a fractal mountain below four balls of glass.
#pragma once

#include "host/generate/classic.hpp"

namespace eyeray::generate {

// What decides a grid point's height, for i, j from 0 to 2ⁿ. It repeats itself: that belongs to the scene.
uint32_t mount_seed(int size_factor, int i, int j);

// A normally distributed number by the polar method, from the package's generator started with `seed`.
double mount_gauss(uint32_t seed);

// Heights of the (2ⁿ + 1)² grid points, row j after row j; the corners, at ±1, lie at 0. By midpoint
// displacement.
std::vector<double> mount_heights(int size_factor);

// 2 · 4ⁿ triangles, a quarter of the square after the other. Needs 8 bytes of memory a grid point.
void mount_mesh(int size_factor, MeshSink& sink);

extern const Classic mount_classic;

}  // namespace eyeray::generate
