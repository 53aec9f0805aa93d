#include <cmath>

#include "classics.hpp"
#include "host/core/parallel_for.hpp"

namespace eyeray::engine::classics {
namespace {

// √(2^(1/3) − 1): scales displacements so that the fractal dimension is 2.2.
constexpr double roughness = 0.5098245285339583;
// The root of two as rounded in the package.
constexpr double root_of_two = 1.4142136;

// Adds the triangles of the square of `cells` cells a side whose first grid point is (i, j).
void add_triangles(Mesh& mesh, int grid, int cells, int i, int j) {
  if (cells > 1) {
    const int half = cells / 2;
    add_triangles(mesh, grid, half, i, j);
    add_triangles(mesh, grid, half, i + half, j);
    add_triangles(mesh, grid, half, i + half, j + half);
    add_triangles(mesh, grid, half, i, j + half);
    return;
  }
  const uint32_t a = uint32_t(j) * uint32_t(grid + 1) + uint32_t(i), b = a + 1;
  const uint32_t d = a + uint32_t(grid + 1), c = d + 1;
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({c, d, a});
}

std::string scene(int) {
  constexpr double radius = 0.17;
  const Vec3 middle{-0.8, 0.8, 1};
  const double height = radius * std::sqrt(1.5), s = std::sqrt(3.0) / 2;
  const Vec3 foot = Vec3(2, -2, -1) * (height / 3);
  // The package's glass scatters a tenth of the light and mirrors a tenth; a dielectric follows Fresnel's
  // equations instead. A shadow ray keeps 0.9 at each of the two crossings.
  std::string text =
      classic_stage({.eye = {-1.6, 1.6, 1.7}, .target = {0, 0, 0}, .lights = {{-100, -100, 100}}}) +
      classic_material({.name = "rock", .color = {0.5, 0.45, 0.35}}) +
      fmt::format(
          "\n[[material]]\nname = \"glass\"\ntype = \"dielectric\"\nior = 1.5\n"
          "shadow = 0.81\nspecular = 0.4\nshininess = {}\n",
          ClassicSurface::shine_7);
  BatchText spheres("sphere", fmt::format("material = \"glass\"\nradius = {}\n", radius), {"center"});
  spheres.add(middle + Vec3(0, 0, height));
  for (const double sine : {0.0, s, -s}) {
    const double cosine = sine == 0 ? 1 : -0.5;
    spheres.add(middle + Vec3(cosine * foot.x - sine * foot.y, sine * foot.x + cosine * foot.y, foot.z));
  }
  return text + spheres.text();
}

}  // namespace

uint32_t mount_seed(int size_factor, int i, int j) {
  const auto term = [](int number, int shift) { return shift < 0 ? 0 : uint32_t(number) << shift; };
  return 21 + (term(i, 23 - size_factor) + term(j, 15 - size_factor) + term(i, 7 - size_factor)) % 65536;
}

double mount_gauss(uint32_t seed) {
  const auto next = [](uint32_t state) { return (28411 + 8121 * uint64_t(state)) % 134456; };
  for (uint32_t state = seed;;) {
    const uint32_t first = uint32_t(next(state));
    state = uint32_t(next(first));
    const double x = 2.0 * first / 134456 - 1, y = 2.0 * state / 134456 - 1;
    const double r = x * x + y * y;
    if (r < 1) return x * std::sqrt(-2 * std::log(r) / r);
  }
}

std::vector<double> mount_heights(int size_factor) {
  const int grid = 1 << size_factor;
  std::vector<double> heights(size_t(grid + 1) * size_t(grid + 1));
  const auto at = [&](int i, int j) -> double& { return heights[size_t(j) * size_t(grid + 1) + size_t(i)]; };

  // Halve the squares again and again: the new points are the middles of squares and of their sides.
  for (int half = grid / 2; half >= 1; half /= 2) {
    const double scale = roughness * 2 * half / grid;
    parallel_for(0, grid / half + 1, [&](int row) {
      const int j = row * half;
      for (int i = row % 2 == 0 ? half : 0; i <= grid; i += row % 2 == 0 ? 2 * half : half) {
        const double displacement = scale * mount_gauss(mount_seed(size_factor, i, j));
        if (row % 2 == 0) {
          at(i, j) = (at(i - half, j) + at(i + half, j)) / 2 + displacement;
        } else if (i / half % 2 == 0) {
          at(i, j) = (at(i, j - half) + at(i, j + half)) / 2 + displacement;
        } else {
          at(i, j) = (at(i - half, j - half) + at(i + half, j - half) + at(i + half, j + half) +
                      at(i - half, j + half)) /
                         4 +
                     root_of_two * displacement;
        }
      }
    });
  }
  return heights;
}

// 2 · 4ⁿ triangles, one quarter of the square after another.
static Mesh mesh(int size_factor) {
  Mesh mesh;
  const int grid = 1 << size_factor;
  const std::vector<double> heights = mount_heights(size_factor);
  const double* height = heights.data();
  for (int j = 0; j <= grid; ++j) {
    for (int i = 0; i <= grid; ++i)
      mesh.positions.emplace_back(-1 + 2.0 * i / grid, -1 + 2.0 * j / grid, *height++);
  }
  add_triangles(mesh, grid, grid, 0, 0);
  return mesh;
}

const Classic mount_classic = {
    .name = "mount",
    .size_factor = 6,
    .shapes = [](int) { return uint64_t{4}; },
    .scene = scene,
    .mesh = mesh,
    .mesh_material = "rock",
};

}  // namespace eyeray::engine::classics
