// A picture while it is rendered: the sums over the samples of its pixels.
#pragma once

#include <span>
#include <vector>

#include "host/core/rect.hpp"
#include "host/film/channel.hpp"

namespace eyeray::engine::film {

// Finished rows of a picture; sinks get them from the top down, none twice.
struct Rows {
  Rows() = default;
  // All 0.
  Rows(int from, int width, int count, Channels channels);

  // The values of one of `channels`.
  const image::Image& operator[](Channel channel) const;

  int first = 0;                     // counted from the top of the rendered rows
  image::Image color;                // linear RGB, the mean of the samples
  Channels channels;                 // all of samples, and …
  std::vector<image::Image> values;  // … of each the means
  uint64_t flagged_pixels = 0;
  uint32_t flags = 0;
};

// Noise is measured in blocks of this many pixels each way, from the top left of the film on.
constexpr int noise_block = 8;

class Film {
 public:
  // Sums those of `channels` that are of samples. All 0. `shown_as_one`: the luminance that a picture shows
  // as 1, the measure of noise in the dark.
  void reset(int width, int height, const Channels& channels, double shown_as_one = 1);
  int width() const { return width_; }
  int height() const { return height_; }
  const Channels& channels() const { return channels_; }

  // One sample of every pixel of `part`, row by row. `auxiliaries`: as many, or none where no channel needs
  // them.
  void add(const Rect& part, std::span<const PixelSample> samples,
           std::span<const AuxiliarySample> auxiliaries = {});
  // The means of rows [first, first + count).
  Rows rows(int first, int count) const;
  // Pixels that take no more samples.
  void finish(const Rect& part);
  bool finished(int x, int y) const { return pixel(x, y).finished; }
  uint64_t samples() const;  // of all pixels
  // The error of pixels relative to their brightness. It is half the width of a pixel's 95 % interval, 1.96
  // √(s²/n) of luminance, as a root mean square over the block, divided by the mean luminance plus 1 % of the
  // luminance shown as 1. NaN where a pixel has one sample, or none has any; pixels without samples do not
  // count otherwise. Samples of one pixel that are spread evenly, as Sobol's, are better than that as a rule.
  // Only with the channel `noise`.
  double noise(const Rect& block) const;

  // The sums in the order of a checkpoint, one after the other, each row by row (render/checkpoint.hpp).
  std::vector<std::span<std::byte>> parts();
  std::vector<std::span<const std::byte>> parts() const;

 private:
  size_t index(int x, int y) const { return size_t(y) * size_t(width_) + size_t(x); }
  const PixelTotals& pixel(int x, int y) const { return pixels_[index(x, y)]; }
  void fill_noise(int first, image::Image& rows) const;

  int width_ = 0;
  int height_ = 0;
  Channels channels_;
  std::vector<PixelTotals> pixels_;
  std::vector<std::vector<double>> sums_;  // of each channel, as many a pixel as it has
  double shown_as_one_ = 1;
};

}  // namespace eyeray::engine::film
