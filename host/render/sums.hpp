// What a picture is while it is rendered: sums over samples.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "host/core/pixel.hpp"
#include "host/image/image.hpp"

namespace eyeray::render {

// Finished rows of a picture; sinks get them from the top down, none twice.
struct FinishedRows {
  FinishedRows() = default;
  // All 0.
  FinishedRows(int from, int width, int count)
      : first(from),
        color(width, count, 3),
        hits(width, count, 1),
        rays_traced(width, count, 1),
        flagged(width, count, 1) {}

  bool has_kinds() const { return kinds.height() > 0; }

  int first = 0;             // counted from the top of what is rendered
  image::Image color;        // linear RGB, the mean of the samples
  image::Image hits;         // 1 channel: surfaces struck a pixel, the mean of the samples
  image::Image rays_traced;  // 1 channel: a pixel, the mean of the samples
  image::Image
      kinds;  // 3 channels: of these the reflected, refracted and shadow rays; empty unless asked for
  image::Image flagged;  // 1 channel: the SampleFlags of all samples of a pixel, as a number
  uint64_t flagged_pixels = 0;
  uint32_t flags = 0;
};

// The sums over the samples of every pixel of a few rows.
class PixelSums {
 public:
  struct Pixel {
    Vec3 color{0.0};
    uint32_t hits = 0;
    uint32_t rays = 0;
    uint32_t flags = 0;
    uint32_t unused = 0;
  };
  // Of the rays those of a kind.
  struct Kinds {
    uint32_t reflected = 0;
    uint32_t refracted = 0;
  };

  // All 0. Without `kinds` there are none, and none in the mean.
  void reset(int width, int height, bool kinds);
  int width() const { return width_; }
  int height() const { return height_; }

  // One sample of every pixel of whole rows, from row `first` on.
  void add(int first, std::span<const PixelSample> samples);
  // The mean of rows [first, first + count), of which those above `extra_rows` have `samples` + 1 samples and
  // the others `samples` > 0.
  FinishedRows mean(int first, int count, int samples, int extra_rows) const;

  // As a checkpoint keeps them, one after the other, each row by row (render/checkpoint.hpp).
  std::array<std::span<std::byte>, 2> parts() {
    return {std::as_writable_bytes(std::span(pixels_)), std::as_writable_bytes(std::span(kinds_))};
  }
  std::array<std::span<const std::byte>, 2> parts() const {
    return {std::as_bytes(std::span(pixels_)), std::as_bytes(std::span(kinds_))};
  }

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<Pixel> pixels_;
  std::vector<Kinds> kinds_;  // as many, or none
};

}  // namespace eyeray::render
