#include "host/render/sums.hpp"

#include "host/core/error.hpp"
#include "host/core/parallel_for.hpp"

namespace eyeray::render {

static_assert(sizeof(PixelSums::Pixel) == 40 && sizeof(PixelSums::Kinds) == 8,
              "checkpoints hold them as they lie in memory");

void PixelSums::reset(int width, int height, bool kinds) {
  width_ = width;
  height_ = height;
  pixels_.assign(size_t(width) * size_t(height), {});
  kinds_.assign(kinds ? pixels_.size() : 0, {});
}

void PixelSums::add(int first, std::span<const PixelSample> samples) {
  const size_t begin = size_t(first) * size_t(width_);
  CHECK_LE(begin + samples.size(), pixels_.size());
  parallel_for(0, int(samples.size()), [&](int i) {
    const PixelSample& sample = samples[size_t(i)];
    Pixel& pixel = pixels_[begin + size_t(i)];
    pixel.color += sample.color;
    pixel.hits += sample.hits;
    pixel.rays += sample.rays;
    pixel.flags |= sample.flags;
    if (kinds_.empty()) return;
    kinds_[begin + size_t(i)].reflected += sample.reflected;
    kinds_[begin + size_t(i)].refracted += sample.refracted;
  });
}

FinishedRows PixelSums::mean(int first, int count, int samples, int extra_rows) const {
  FinishedRows rows(first, width_, count);
  if (!kinds_.empty()) rows.kinds = image::Image(width_, count, 3);
  for (int y = 0; y < count; ++y) {
    const int taken = first + y < extra_rows ? samples + 1 : samples;
    for (int x = 0; x < width_; ++x) {
      const size_t i = size_t(first + y) * size_t(width_) + size_t(x);
      const Pixel& pixel = pixels_[i];
      const auto divisor = double(taken);
      for (int c = 0; c < 3; ++c) rows.color.pixel(x, y)[c] = float(pixel.color[c] / divisor);
      *rows.hits.pixel(x, y) = float(double(pixel.hits) / divisor);
      *rows.rays_traced.pixel(x, y) = float(double(pixel.rays) / divisor);
      *rows.flagged.pixel(x, y) = float(pixel.flags);
      if (!kinds_.empty()) {
        const Kinds& kinds = kinds_[i];
        const uint32_t shadow = pixel.rays - uint32_t(taken) - kinds.reflected - kinds.refracted;
        float* mean = rows.kinds.pixel(x, y);
        mean[0] = float(kinds.reflected / divisor);
        mean[1] = float(kinds.refracted / divisor);
        mean[2] = float(shadow / divisor);
      }
      rows.flags |= pixel.flags;
      rows.flagged_pixels += pixel.flags != 0;
    }
  }
  return rows;
}

}  // namespace eyeray::render
