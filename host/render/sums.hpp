// What a picture is while it is rendered: sums over samples.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "host/core/pixel.hpp"
#include "host/core/rect.hpp"
#include "host/image/image.hpp"

namespace eyeray::render {

// What is summed only where it is asked for.
struct Counted {
  bool kinds = false;  // of rays
  bool noise = false;
  bool brightest = false;  // of the samples
  bool auxiliary = false;  // what a denoiser asks for
};

// Finished rows of a picture; sinks get them from the top down, none twice.
struct FinishedRows {
  FinishedRows() = default;
  // All 0.
  FinishedRows(int from, int width, int count, Counted counted = {})
      : first(from),
        color(width, count, 3),
        hits(width, count, 1),
        rays_traced(width, count, 1),
        samples(width, count, 1),
        flagged(width, count, 1) {
    if (counted.kinds) kinds = image::Image(width, count, 3);
    if (counted.noise) noise = image::Image(width, count, 1);
    if (counted.brightest) brightest = image::Image(width, count, 1);
    if (counted.auxiliary) albedo = normal = image::Image(width, count, 3);
  }

  bool has_kinds() const { return kinds.height() > 0; }

  int first = 0;             // counted from the top of what is rendered
  image::Image color;        // linear RGB, the mean of the samples
  image::Image hits;         // 1 channel: surfaces struck a pixel, the mean of the samples
  image::Image rays_traced;  // 1 channel: a pixel, the mean of the samples
  image::Image samples;      // 1 channel: how many a pixel has
  image::Image
      kinds;  // 3 channels: of these rays the reflected, refracted and shadow rays; empty unless asked for
  // Empty unless asked for:
  image::Image noise;           // 1 channel: PixelSums::noise of a pixel's block
  image::Image brightest;       // 1 channel: the greatest luminance of a sample
  image::Image albedo, normal;  // 3 channels each: of AuxiliarySample, the mean of the samples
  image::Image flagged;         // 1 channel: the SampleFlags of all samples of a pixel, as a number
  uint64_t flagged_pixels = 0;
  uint32_t flags = 0;
};

// Noise is measured in blocks of this many pixels each way, from the top left of the sums on.
constexpr int noise_block = 8;

// The sums over the samples of every pixel of a few rows.
class PixelSums {
 public:
  struct Pixel {
    Vec3 color{0.0};
    uint32_t hits = 0;
    uint32_t rays = 0;
    uint32_t flags = 0;
    uint32_t samples : 31 = 0;
    uint32_t finished : 1 = 0;  // whether it takes no more (render/adaptive.hpp)
  };
  // Of the rays those of a kind.
  struct Kinds {
    uint32_t reflected = 0;
    uint32_t refracted = 0;
  };

  struct Auxiliary {
    Vec3 albedo{0.0};
    Vec3 normal{0.0};
  };

  // All 0. `shown_as_one`: the luminance that a picture shows as 1, the measure of noise in the dark.
  void reset(int width, int height, Counted counted, double shown_as_one = 1);
  int width() const { return width_; }
  int height() const { return height_; }

  // One sample of every pixel of `part`, row by row.
  void add(const Rect& part, std::span<const PixelSample> samples);
  // What a denoiser asks of the same.
  void add(const Rect& part, std::span<const AuxiliarySample> samples);
  // The mean of rows [first, first + count).
  FinishedRows mean(int first, int count) const;
  // Pixels that take no more samples.
  void finish(const Rect& part);
  bool finished(int x, int y) const { return pixel(x, y).finished; }
  uint64_t samples() const;  // of all pixels
  // How far pixels may be off, relative to how bright they are: half the width of a pixel's 95 % interval,
  // 1.96 √(s²/n) of luminance, the root of the mean square over the block, by the mean luminance plus 1 % of
  // what is shown as 1. NaN where a pixel has one sample, or none has any; others without are none. Samples
  // of one pixel that are spread evenly, as Sobol's, are better than that as a rule.
  double noise(const Rect& block) const;

  // As a checkpoint keeps them, one after the other, each row by row (render/checkpoint.hpp).
  std::array<std::span<std::byte>, 5> parts() {
    return {std::as_writable_bytes(std::span(pixels_)), std::as_writable_bytes(std::span(kinds_)),
            std::as_writable_bytes(std::span(squares_)), std::as_writable_bytes(std::span(brightest_)),
            std::as_writable_bytes(std::span(auxiliaries_))};
  }
  std::array<std::span<const std::byte>, 5> parts() const {
    return {std::as_bytes(std::span(pixels_)), std::as_bytes(std::span(kinds_)),
            std::as_bytes(std::span(squares_)), std::as_bytes(std::span(brightest_)),
            std::as_bytes(std::span(auxiliaries_))};
  }

 private:
  size_t index(int x, int y) const { return size_t(y) * size_t(width_) + size_t(x); }
  const Pixel& pixel(int x, int y) const { return pixels_[index(x, y)]; }

  int width_ = 0;
  int height_ = 0;
  std::vector<Pixel> pixels_;
  std::vector<Kinds> kinds_;            // as many, or none
  std::vector<double> squares_;         // of the samples' luminances; as many, or none
  std::vector<float> brightest_;        // likewise
  std::vector<Auxiliary> auxiliaries_;  // likewise
  double shown_as_one_ = 1;
};

}  // namespace eyeray::render
