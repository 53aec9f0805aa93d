#include "host/denoise/regression.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "host/denoise/shader_functions.hpp"
#include "host/denoise/wide_vectors.hpp"

namespace eyeray::engine::denoise {
namespace {

using Equations = shader::NormalEquations;  // the equations of LANES pixels

static_assert(tile_width % LANES == 0 && feature_count == FEATURES);

// Adds the neighbours of the pixels from (x, y) on, which are from `left` on in their row of the tile.
template <int count>
IN_CALLER void add_window(const Planes& colors, const Planes& features, const Distances& distances,
                          float strictness, int left, int x, int y, int row, Equations& sums) {
  const int radius = distances.radius();
  float weight[LANES], terms[FEATURES][LANES], there[MOST_COLORS][LANES];
  for (int dy = -radius; dy <= radius; ++dy) {
    for (int dx = -radius; dx <= radius; ++dx) {
      const float* const distance = distances.row(dx, dy, row) + left;
      EACH_LANE weight[lane] = shader::neighbour_weight(strictness * distance[lane]);
      uint32_t any = 0;
      EACH_LANE any |= std::bit_cast<uint32_t>(weight[lane]);
      if (any == 0) continue;
      for (int f = 0; f < FEATURES; ++f) {
        const float* const feature = features.at(f, x + dx, y + dy);
        const float* const here = features.at(f, x, y);
        EACH_LANE terms[f][lane] = feature[lane] - here[lane];
      }
      for (int c = 0; c < count; ++c) {
        const float* const color = colors.at(c, x + dx, y + dy);
        EACH_LANE there[c][lane] = color[lane];
      }
      shader::add_neighbour(sums, weight, terms, there, count);
    }
  }
  shader::solve(sums, count);
}

// Returns the solved equations of the pixels from (x, y) on.
IN_WIDE_VECTORS Equations solved_equations(const Planes& colors, const Planes& features,
                                           const Distances& distances, float strictness, int left, int x,
                                           int y, int row) {
  Equations sums{};
  if (colors.count() == 3)
    add_window<3>(colors, features, distances, strictness, left, x, y, row, sums);
  else
    add_window<4>(colors, features, distances, strictness, left, x, y, row, sums);
  return sums;
}

}  // namespace

void fit_tile(const Planes& colors, const Planes& features, const Distances& distances, float strictness,
              int x, int y, Planes& fitted) {
  const int rows = std::min(tile_height, colors.height() - y);
  const int columns = std::min(tile_width, colors.width() - x);
  for (int row = 0; row < rows; ++row) {
    for (int left = 0; left < columns; left += LANES) {
      const Equations solved =
          solved_equations(colors, features, distances, strictness, left, x + left, y + row, row);
      for (int c = 0; c < colors.count(); ++c)
        std::copy_n(solved.sides[SIDE(FEATURES, c)], std::min(LANES, columns - left),
                    fitted.at(c, x + left, y + row));
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
    std::fill_n(weight_sums, tile_width, LEAST_WEIGHT);
    for (int dy = -radius; dy <= radius; ++dy) {
      for (int dx = -radius; dx <= radius; ++dx) {
        const float* const distance = distances.row(dx, dy, row);
        for (int i = 0; i < tile_width; ++i) weight[i] = shader::neighbour_weight(distance[i]);
        for (int i = 0; i < tile_width; ++i) weight_sums[i] += weight[i];
        for (int f = 0; f < feature_count; ++f) {
          const float* const value = values.at(f, x + dx, y + row + dy);
          for (int i = 0; i < tile_width; ++i) sums[f][i] += weight[i] * value[i];
        }
      }
    }
    for (int f = 0; f < feature_count; ++f)
      for (int i = 0; i < columns; ++i)
        *means.at(f, x + i, y + row) += shader::half_of_mean(sums[f][i], weight_sums[i]);
  }
}

}  // namespace eyeray::engine::denoise
