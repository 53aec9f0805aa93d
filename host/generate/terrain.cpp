#include "host/generate/terrain.hpp"

#include <bit>
#include <cmath>
#include <vector>

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"
#include "host/generate/noise.hpp"

namespace eyeray::engine::generate {
namespace {

constexpr double reach = 5;        // half the side of the square
constexpr double height = 1.4;     // height of the first octave
constexpr double frequency = 0.3;  // frequency of the first octave, in lattice cells a unit of length
constexpr int rows_at_once = 64;

// Rows of heights, made in parallel.
class Rows {
 public:
  // The rows from `first` on, `count` of them, and one more on either side, which their normals need.
  Rows(const TerrainOptions& options, int first, int count)
      : grid_(options.grid), first_(first - 1), heights_(size_t(count + 2)) {
    parallel_for(0, count + 2, [&](int i) {
      std::vector<double>& row = heights_[size_t(i)];
      row.reserve(size_t(grid_ + 1));
      for (int column = 0; column <= grid_; ++column)
        row.push_back(terrain_height(options, {coordinate(column), coordinate(first_ + i)}));
    });
  }

  double coordinate(int i) const { return -reach + 2 * reach * i / grid_; }
  Vec3 vertex(int row, int column) const { return {coordinate(column), at(row, column), coordinate(row)}; }
  Vec3 normal(int row, int column) const;

 private:
  double at(int row, int column) const { return heights_[size_t(row - first_)][size_t(column)]; }

  int grid_;
  int first_;
  std::vector<std::vector<double>> heights_;
};

// The normal of a vertex, from central differences. It is flattened where it would be on the wrong side of a
// triangle around the vertex.
Vec3 Rows::normal(int row, int column) const {
  const double cell = 2 * reach / grid_;
  const int left = std::max(0, column - 1), right = std::min(grid_, column + 1);
  const double here = at(row, column);
  const double west = here - at(row, left), east = at(row, right) - here;
  const double north = here - at(row - 1, column), south = at(row + 1, column) - here;
  const Vec2 slope{(west + east) / (cell * (right - left)), (north + south) / (2 * cell)};

  // The slopes of the six triangles: each has an edge along x and one along z.
  const Vec2 slopes[6] = {{east, south},
                          {west, at(row + 1, left) - at(row, left)},
                          {at(row + 1, column) - at(row + 1, left), south},
                          {at(row - 1, right) - at(row - 1, column), north},
                          {east, at(row, right) - at(row - 1, right)},
                          {west, north}};
  double against = 0;
  for (const Vec2& each : slopes) against = std::min(against, glm::dot(slope, each) / cell);
  const double flatter = against < -0.9 ? -0.9 / against : 1;
  return glm::normalize(Vec3(-slope.x * flatter, 1, -slope.y * flatter));
}

}  // namespace

double terrain_height(const TerrainOptions& options, const Vec2& p) {
  // The finest octave has two grid cells or more to a lattice cell.
  const double cells_to_one = std::max(1.0, options.grid / (2 * reach * frequency));
  const int octaves = std::max(1, int(std::bit_width(uint32_t(cells_to_one))) - 1);

  // Further octaves count for less on steep slopes: ridges stay sharp, slopes smooth, valleys flat, as
  // erosion leaves them (Quilez, "Painting a landscape with maths", 2020).
  Vec2 q = p * frequency, slope(0.0);
  double sum = 0, amplitude = 1;
  for (int octave = 0; octave < octaves; ++octave) {
    const Noise n = noise(q, options.seed + uint32_t(octave));
    slope += n.gradient;
    sum += amplitude * n.value / (1 + glm::dot(slope, slope));
    amplitude *= options.roughness;
    q = 2.0 * Vec2(0.8 * q.x - 0.6 * q.y, 0.6 * q.x + 0.8 * q.y);  // turned, so that lattices do not align
  }
  return height * sum;
}

void terrain_mesh(const TerrainOptions& options, MeshSink& sink) {
  const int grid = options.grid;
  CHECK_LE(1, grid);
  CHECK_LE(grid, max_terrain_grid);
  sink.begin(uint64_t(grid + 1) * uint64_t(grid + 1), 2 * uint64_t(grid) * uint64_t(grid));

  for (int first = 0; first <= grid; first += rows_at_once) {
    const int end = std::min(first + rows_at_once, grid + 1);
    const Rows rows(options, first, end - first);
    for (int row = first; row < end; ++row) {
      for (int column = 0; column <= grid; ++column)
        sink.vertex(rows.vertex(row, column), rows.normal(row, column));
    }
  }

  for (int row = 0; row < grid; ++row) {
    for (int column = 0; column < grid; ++column) {
      const uint32_t a = uint32_t(row) * uint32_t(grid + 1) + uint32_t(column), b = a + 1;
      const uint32_t c = a + uint32_t(grid + 1), d = c + 1;
      sink.triangle(a, c, b);
      sink.triangle(b, c, d);
    }
  }
}

int terrain_grid(uint64_t triangles) {
  return std::max(1, int(std::lround(std::sqrt(double(triangles) / 2))));
}

std::string terrain_stage() {
  return R"([image]
width = 1024
height = 768

[camera]
eye = [0, 3.2, -6.8]
target = [0, 0.4, 0]
fov = 50

[render]
background = [0.52, 0.66, 0.86]
ambient = [0.3, 0.36, 0.46]

[[light]]
type = "directional"
direction = [0.9, -0.55, 0.35]
intensity = [1.25, 1.08, 0.82]

[[material]]
name = "ground"
type = "phong"
diffuse = [0.62, 0.5, 0.36]
)";
}

}  // namespace eyeray::engine::generate
