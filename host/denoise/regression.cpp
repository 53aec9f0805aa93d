#include "host/denoise/regression.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "host/denoise/wide_vectors.hpp"

namespace eyeray::engine::denoise {
namespace {

constexpr int unknowns = 1 + feature_count;
constexpr int products = unknowns * (unknowns + 1) / 2;
constexpr int most_colors = 4;  // with an alpha
constexpr int lanes = 16;       // pixels at a time
constexpr double cost = 1e-3;   // the cost of a squared coefficient, relative to the sum of the weights

static_assert(tile_width % lanes == 0);

// The normal equations of `lanes` pixels: the upper triangle of the matrix row by row, and the right sides.
struct Equations {
  float matrix[products][lanes]{};
  float sides[unknowns * most_colors][lanes]{};
};

IN_WIDE_VECTORS Equations equations_of(const Planes& colors, const Planes& features,
                                       const Distances& distances, float strictness, int left, int x, int y,
                                       int row) {
  Equations all;
  const int radius = distances.radius(), count = colors.count();
  float terms[unknowns][lanes], weighted[unknowns][lanes];
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const float* const distance = distances.row(dx, dy, row) + left;
      float* const weight = weighted[0];
      for (int i = 0; i < lanes; ++i) weight[i] = weight_at(strictness * distance[i]);
      uint32_t any = 0;
      for (int i = 0; i < lanes; ++i) any |= std::bit_cast<uint32_t>(weight[i]);
      if (any == 0) continue;
      for (int f = 0; f < feature_count; ++f) {
        const float* const there = features.at(f, x + dx, y + dy);
        const float* const here = features.at(f, x, y);
        for (int i = 0; i < lanes; ++i) terms[f + 1][i] = there[i] - here[i];
        for (int i = 0; i < lanes; ++i) weighted[f + 1][i] = weight[i] * terms[f + 1][i];
      }
      for (int i = 0; i < lanes; ++i) all.matrix[0][i] += weight[i];
      int at = 1;
      for (int g = 1; g < unknowns; ++g, ++at)
        for (int i = 0; i < lanes; ++i) all.matrix[at][i] += weighted[g][i];
      for (int f = 1; f < unknowns; ++f)
        for (int g = f; g < unknowns; ++g, ++at)
          for (int i = 0; i < lanes; ++i) all.matrix[at][i] += weighted[f][i] * terms[g][i];
      for (int c = 0; c < count; ++c) {
        const float* const color = colors.at(c, x + dx, y + dy);
        for (int f = 0; f < unknowns; ++f)
          for (int i = 0; i < lanes; ++i) all.sides[f * most_colors + c][i] += weighted[f][i] * color[i];
      }
    }
  }
  return all;
}

// The first unknown of a pixel's equations for each of `count` colours, by Cholesky's decomposition.
std::array<double, most_colors> solve(const Equations& equations, int count, int lane) {
  // The first unknown comes last, for then it is the first that is known.
  double lower[unknowns][unknowns];
  double sides[unknowns][most_colors];
  const auto place = [](int f) { return unknowns - 1 - f; };
  int at = 0;
  for (int f = 0; f < unknowns; ++f)
    for (int g = f; g < unknowns; ++g) lower[place(f)][place(g)] = double(equations.matrix[at++][lane]);
  for (int f = 0; f < unknowns; ++f)
    for (int c = 0; c < count; ++c) sides[place(f)][c] = double(equations.sides[f * most_colors + c][lane]);
  const double sum = lower[unknowns - 1][unknowns - 1];
  for (int i = 0; i < unknowns - 1; ++i) lower[i][i] += cost * sum;

  for (int i = 0; i < unknowns; ++i) {
    for (int j = 0; j <= i; ++j) {
      double value = lower[i][j];
      for (int k = 0; k < j; ++k) value -= lower[i][k] * lower[j][k];
      lower[i][j] = i == j ? std::sqrt(std::max(value, 1e-12 * sum)) : value / lower[j][j];
    }
    for (int c = 0; c < count; ++c) {
      for (int k = 0; k < i; ++k) sides[i][c] -= lower[i][k] * sides[k][c];
      sides[i][c] /= lower[i][i];
    }
  }
  std::array<double, most_colors> first{};
  for (int c = 0; c < count; ++c)
    first[size_t(c)] = sides[unknowns - 1][c] / lower[unknowns - 1][unknowns - 1];
  return first;
}

}  // namespace

void fit_tile(const Planes& colors, const Planes& features, const Distances& distances, float strictness,
              int x, int y, Planes& fitted) {
  const int rows = std::min(tile_height, colors.height() - y);
  const int columns = std::min(tile_width, colors.width() - x);
  for (int row = 0; row < rows; ++row) {
    for (int left = 0; left < columns; left += lanes) {
      const Equations equations =
          equations_of(colors, features, distances, strictness, left, x + left, y + row, row);
      for (int i = 0; i < std::min(lanes, columns - left); ++i) {
        const std::array<double, most_colors> color = solve(equations, colors.count(), i);
        for (int c = 0; c < colors.count(); ++c)
          *fitted.at(c, x + left + i, y + row) = float(std::max(0.0, color[size_t(c)]));
      }
    }
  }
}

IN_WIDE_VECTORS void average_tile(const Planes& values, const Distances& distances, int x, int y,
                                  Planes& means) {
  const int rows = std::min(tile_height, values.height() - y);
  const int columns = std::min(tile_width, values.width() - x);
  const int radius = distances.radius();
  float sums[feature_count][tile_width];
  float weight[tile_width], weight_sums[tile_width];
  for (int row = 0; row < rows; ++row) {
    for (float(&each)[tile_width] : sums) std::fill_n(each, tile_width, 0.0f);
    std::fill_n(weight_sums, tile_width, 1e-20f);
    for (int dy = -radius; dy <= radius; ++dy) {
      for (int dx = -radius; dx <= radius; ++dx) {
        const float* const distance = distances.row(dx, dy, row);
        for (int i = 0; i < tile_width; ++i) weight[i] = weight_at(distance[i]);
        for (int i = 0; i < tile_width; ++i) weight_sums[i] += weight[i];
        for (int f = 0; f < feature_count; ++f) {
          const float* const value = values.at(f, x + dx, y + row + dy);
          for (int i = 0; i < tile_width; ++i) sums[f][i] += weight[i] * value[i];
        }
      }
    }
    for (int f = 0; f < feature_count; ++f)
      for (int i = 0; i < columns; ++i) *means.at(f, x + i, y + row) += 0.5f * sums[f][i] / weight_sums[i];
  }
}

}  // namespace eyeray::engine::denoise
