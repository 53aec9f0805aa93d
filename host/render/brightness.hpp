// A histogram of samples' brightness: a count for each eighth of an octave, independent of their order.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "host/core/pixel.hpp"
#include "host/image/image.hpp"

namespace eyeray::engine::render {

class Brightness {
 public:
  void add(std::span<const PixelSample> samples);
  // The number of samples with more than `luminance`. Of samples that are hardly brighter only some are
  // counted. Returns 0 unless `luminance` is above 0.
  uint64_t above(double luminance) const;
  // The number of samples so much brighter than the mean that they appear as dots, in a picture of `pixels`
  // pixels whose luminances sum to `luminances`.
  uint64_t fireflies(double luminances, int64_t pixels) const {
    return above(times_of_fireflies * luminances / double(pixels));
  }
  static constexpr double times_of_fireflies = 1000;
  // Adds the counts of another machine.
  void add(const Brightness& other);
  std::array<uint64_t, 2048>& counts() { return counts_; }
  const std::array<uint64_t, 2048>& counts() const { return counts_; }

 private:
  std::array<uint64_t, 2048>
      counts_{};  // by the upper bits of a float32: its exponent, and three bits of its fraction
};

// The sum of the luminances of all pixels in rows of colours.
double sum_of_luminances(const image::Image& rows);

}  // namespace eyeray::engine::render
