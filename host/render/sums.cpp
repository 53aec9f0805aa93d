#include "host/render/sums.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"
#include "host/scene/luminance.hpp"

namespace eyeray::render {

static_assert(sizeof(PixelSums::Pixel) == 40 && sizeof(PixelSums::Kinds) == 8 &&
                  sizeof(PixelSums::Auxiliary) == 48,
              "checkpoints hold them as they lie in memory");

void PixelSums::reset(int width, int height, Counted counted, double shown_as_one) {
  width_ = width;
  height_ = height;
  shown_as_one_ = shown_as_one;
  pixels_.assign(size_t(width) * size_t(height), {});
  kinds_.assign(counted.kinds ? pixels_.size() : 0, {});
  squares_.assign(counted.noise ? pixels_.size() : 0, 0);
  brightest_.assign(counted.brightest ? pixels_.size() : 0, 0);
  auxiliaries_.assign(counted.auxiliary ? pixels_.size() : 0, {});
}

void PixelSums::add(const Rect& part, std::span<const PixelSample> samples) {
  CHECK_EQ(samples.size(), size_t(part.pixels()));
  CHECK(part.x + part.width <= width_ && part.y + part.height <= height_);
  parallel_for(0, int(samples.size()), [&](int i) {
    const PixelSample& sample = samples[size_t(i)];
    const size_t at = index(part.x + i % part.width, part.y + i / part.width);
    Pixel& pixel = pixels_[at];
    pixel.color += sample.color;
    pixel.hits += sample.hits;
    pixel.rays += sample.rays;
    pixel.flags |= sample.flags;
    ++pixel.samples;
    if (!squares_.empty()) squares_[at] += luminance(sample.color) * luminance(sample.color);
    if (!brightest_.empty()) brightest_[at] = std::max(brightest_[at], float(luminance(sample.color)));
    if (kinds_.empty()) return;
    kinds_[at].reflected += sample.reflected;
    kinds_[at].refracted += sample.refracted;
  });
}

void PixelSums::add(const Rect& part, std::span<const AuxiliarySample> samples) {
  CHECK_EQ(samples.size(), size_t(part.pixels()));
  for (size_t i = 0; i < samples.size(); ++i) {
    const size_t at = index(part.x + int(i) % part.width, part.y + int(i) / part.width);
    auxiliaries_[at].albedo += samples[i].albedo;
    auxiliaries_[at].normal += samples[i].normal;
    pixels_[at].flags |= samples[i].flags;
  }
}

void PixelSums::finish(const Rect& part) {
  for (int y = part.y; y < part.y + part.height; ++y)
    for (int x = part.x; x < part.x + part.width; ++x) pixels_[index(x, y)].finished = 1;
}

uint64_t PixelSums::samples() const {
  uint64_t sum = 0;
  for (const Pixel& pixel : pixels_) sum += pixel.samples;
  return sum;
}

double PixelSums::noise(const Rect& block) const {
  double variances = 0, brightness = 0, pixels = 0;
  for (int y = block.y; y < block.y + block.height; ++y) {
    for (int x = block.x; x < block.x + block.width; ++x) {
      const Pixel& one = pixel(x, y);
      const double n = one.samples, sum = luminance(one.color);
      if (n == 0) continue;  // as in mean
      if (n < 2) return std::numeric_limits<double>::quiet_NaN();
      ++pixels;
      variances += std::max(0.0, squares_[index(x, y)] - sum * sum / n) / (n * (n - 1));
      brightness += sum / n;
    }
  }
  return 1.96 * std::sqrt(variances / pixels) / (brightness / pixels + 0.01 * shown_as_one_);
}

FinishedRows PixelSums::mean(int first, int count) const {
  FinishedRows rows(first, width_, count,
                    {.kinds = !kinds_.empty(),
                     .noise = !squares_.empty(),
                     .brightest = !brightest_.empty(),
                     .auxiliary = !auxiliaries_.empty()});
  for (int y = 0; y < count; ++y) {
    for (int x = 0; x < width_; ++x) {
      const Pixel& sums = pixel(x, first + y);
      // What is no pixel, beside or below a shard's tile, has none.
      const double divisor = std::max(1u, unsigned{sums.samples});
      for (int c = 0; c < 3; ++c) rows.color.pixel(x, y)[c] = float(sums.color[c] / divisor);
      *rows.hits.pixel(x, y) = float(double(sums.hits) / divisor);
      *rows.rays_traced.pixel(x, y) = float(double(sums.rays) / divisor);
      *rows.samples.pixel(x, y) = float(sums.samples);
      *rows.flagged.pixel(x, y) = float(sums.flags);
      if (!kinds_.empty()) {
        const Kinds& kinds = kinds_[index(x, first + y)];
        const uint32_t shadow = sums.rays - sums.samples - kinds.reflected - kinds.refracted;
        float* mean = rows.kinds.pixel(x, y);
        mean[0] = float(kinds.reflected / divisor);
        mean[1] = float(kinds.refracted / divisor);
        mean[2] = float(shadow / divisor);
      }
      if (!brightest_.empty()) *rows.brightest.pixel(x, y) = brightest_[index(x, first + y)];
      if (!auxiliaries_.empty()) {
        const Auxiliary& auxiliary = auxiliaries_[index(x, first + y)];
        for (int c = 0; c < 3; ++c) {
          rows.albedo.pixel(x, y)[c] = float(auxiliary.albedo[c] / divisor);
          rows.normal.pixel(x, y)[c] = float(auxiliary.normal[c] / divisor);
        }
      }
      rows.flags |= sums.flags;
      rows.flagged_pixels += sums.flags != 0;
    }
  }
  if (squares_.empty()) return rows;
  for (int top = first / noise_block * noise_block; top < first + count; top += noise_block) {
    for (int left = 0; left < width_; left += noise_block) {
      const Rect block{left, top, std::min(noise_block, width_ - left), std::min(noise_block, height_ - top)};
      const auto value = float(noise(block));
      for (int y = std::max(first, top); y < std::min(first + count, top + block.height); ++y)
        std::fill_n(rows.noise.pixel(left, y - first), block.width, value);
    }
  }
  return rows;
}

}  // namespace eyeray::render
