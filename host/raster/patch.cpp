#include "host/raster/patch.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::raster {
namespace {

constexpr int most_steps = 512;

std::array<double, 4> bernstein(double t) {
  const double s = 1 - t;
  return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
}

}  // namespace

Tessellation tessellate_patch(const std::array<Vec3, 16>& net, double tolerance) {
  // A second derivative is nowhere longer than the longest vector of its own control net.
  const auto p = [&](size_t row, size_t column) { return net[4 * row + column]; };
  double along_row = 0, along_column = 0, mixed = 0;
  for (size_t i = 0; i < 4; ++i) {
    for (size_t k = 0; k < 2; ++k) {
      along_row = std::max(along_row, 6 * glm::length(p(i, k) - 2.0 * p(i, k + 1) + p(i, k + 2)));
      along_column = std::max(along_column, 6 * glm::length(p(k, i) - 2.0 * p(k + 1, i) + p(k + 2, i)));
    }
  }
  for (size_t i = 0; i < 3; ++i)
    for (size_t k = 0; k < 3; ++k)
      mixed = std::max(mixed, 9 * glm::length(p(i, k) - p(i, k + 1) - p(i + 1, k) + p(i + 1, k + 1)));
  const double bend = (along_row + 2 * mixed + along_column) / 8;
  const int steps = int(std::clamp(std::ceil(std::sqrt(bend / tolerance)), 1.0, double(most_steps)));

  Tessellation result;
  for (int j = 0; j <= steps; ++j) {
    const auto down = bernstein(double(j) / steps);
    for (int i = 0; i <= steps; ++i) {
      const auto right = bernstein(double(i) / steps);
      Vec3 point(0.0);
      for (size_t row = 0; row < 4; ++row)
        for (size_t column = 0; column < 4; ++column) point += down[row] * right[column] * p(row, column);
      result.points.push_back(point);
    }
  }
  const auto at = [&](int j, int i) { return uint32_t(j * (steps + 1) + i); };
  for (int j = 0; j < steps; ++j) {
    for (int i = 0; i < steps; ++i) {
      result.triangles.push_back({at(j, i), at(j, i + 1), at(j + 1, i + 1)});
      result.triangles.push_back({at(j, i), at(j + 1, i + 1), at(j + 1, i)});
    }
  }
  result.bound = bend / (double(steps) * steps);
  return result;
}

}  // namespace eyeray::engine::raster
