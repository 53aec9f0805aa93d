#include "host/denoise/block_means.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/parallel_for.hpp"

namespace eyeray::engine::denoise {
namespace {

using image::Image;

// The factor of each block.
Image factors_of(const Image& noisy, const Planes& valid, const Image& picture) {
  const auto blocks = [](int size) { return (size + block_size - 1) / block_size; };
  Image factors(blocks(noisy.width()), blocks(noisy.height()), noisy.channels());
  parallel_for(0, factors.width() * factors.height(), [&](int block) {
    const int left = block % factors.width(), top = block / factors.width();
    for (int c = 0; c < noisy.channels(); ++c) {
      double wanted = 0, present = 0;
      for (int y = top * block_size; y < std::min((top + 1) * block_size, noisy.height()); ++y) {
        for (int x = left * block_size; x < std::min((left + 1) * block_size, noisy.width()); ++x) {
          if (*valid.at(0, x, y) == 0) continue;
          wanted += double(noisy.pixel(x, y)[c]);
          present += double(picture.pixel(x, y)[c]);
        }
      }
      const double factor = wanted / present;
      factors.pixel(left, top)[c] = present > 0 && wanted > 0 && std::isfinite(factor) ? float(factor) : 1.0f;
    }
  });
  return factors;
}

// The two blocks between whose centres a pixel lies, and its share of the second.
struct Between {
  int first, second;
  float share;
};
Between between(int pixel, int blocks) {
  const float at = (float(pixel) + 0.5f) / float(block_size) - 0.5f;
  const int below = int(std::floor(at));
  return {std::clamp(below, 0, blocks - 1), std::clamp(below + 1, 0, blocks - 1), at - float(below)};
}

}  // namespace

void keep_block_means(const Image& noisy, const Planes& valid, Image& picture) {
  for (int repeat = 0; repeat < 8; ++repeat) {
    const Image factors = factors_of(noisy, valid, picture);
    parallel_for(0, picture.height(), [&](int y) {
      const Between row = between(y, factors.height());
      for (int x = 0; x < picture.width(); ++x) {
        if (*valid.at(0, x, y) == 0) continue;
        const Between column = between(x, factors.width());
        for (int c = 0; c < picture.channels(); ++c) {
          const auto across = [&](int j) {
            return factors.pixel(column.first, j)[c] * (1 - column.share) +
                   factors.pixel(column.second, j)[c] * column.share;
          };
          picture.pixel(x, y)[c] *= across(row.first) * (1 - row.share) + across(row.second) * row.share;
        }
      }
    });
  }
}

}  // namespace eyeray::engine::denoise
