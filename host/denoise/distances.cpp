#include "host/denoise/distances.hpp"

#include "host/denoise/shader_functions.hpp"
#include "host/denoise/wide_vectors.hpp"

namespace eyeray::engine::denoise {
namespace {

constexpr int patch = 2 * patch_radius + 1;
constexpr int high = tile_height + 2 * patch_radius;
constexpr int wide = tile_width + 8;  // a whole number of vectors; the last two columns are not used

}  // namespace

IN_WIDE_VECTORS void Distances::compute(const Planes& values, const Planes& variances, float least,
                                        const Planes& valid, int x, int y) {
  const int planes = values.count();
  const float mean = shader::share_of_patch(planes), own_mean = shader::share_of_own(planes);
  const int rows = std::min(tile_height, values.height() - y);
  const int left = x - patch_radius, top = y - patch_radius;
  float differences[high][wide];
  float sums[high][tile_width];
  for (int dy = -radius_; dy <= radius_; ++dy) {
    for (int dx = -radius_; dx <= radius_; ++dx) {
      for (int j = 0; j < rows + 2 * patch_radius; ++j) {
        float* const row = differences[j];
        std::fill_n(row, wide, 0.0f);
        for (int plane = 0; plane < planes; ++plane) {
          const float* const a = values.at(plane, left, top + j);
          const float* const b = values.at(plane, left + dx, top + j + dy);
          const float* const va = variances.at(plane, left, top + j);
          const float* const vb = variances.at(plane, left + dx, top + j + dy);
          for (int i = 0; i < wide; ++i) row[i] += shader::patch_difference(a[i], b[i], va[i], vb[i], least);
        }
        const float* const here = valid.at(0, left, top + j);
        const float* const there = valid.at(0, left + dx, top + j + dy);
        for (int i = 0; i < wide; ++i) row[i] *= here[i] * there[i];
        std::fill_n(sums[j], tile_width, 0.0f);
        for (int k = 0; k < patch; ++k)
          for (int i = 0; i < tile_width; ++i) sums[j][i] += row[i + k];
      }
      for (int j = 0; j < rows; ++j) {
        float* const out = &values_[index(dx, dy, j)];
        std::fill_n(out, tile_width, 0.0f);
        for (int k = 0; k < patch; ++k)
          for (int i = 0; i < tile_width; ++i) out[i] += sums[j + k][i];
        const float* const own = &differences[j + patch_radius][patch_radius];
        const float* const counts = valid.at(0, x + dx, y + j + dy);
        for (int i = 0; i < tile_width; ++i)
          out[i] = shader::patch_distance(out[i] * mean, own[i] * own_mean, counts[i]);
      }
    }
  }
}

}  // namespace eyeray::engine::denoise
