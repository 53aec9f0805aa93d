// How bright samples are: a count for each eighth of an octave, whatever their order.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "host/core/pixel.hpp"

namespace eyeray::render {

class Brightness {
 public:
  void add(std::span<const PixelSample> samples);
  // How many have more luminance than that, which is above 0; of those hardly brighter only some. 0 else.
  uint64_t above(double luminance) const;
  // What another machine counted.
  void add(const Brightness& other);
  std::array<uint64_t, 2048>& counts() { return counts_; }
  const std::array<uint64_t, 2048>& counts() const { return counts_; }

 private:
  std::array<uint64_t, 2048>
      counts_{};  // by the upper bits of a float32: exponent, and three of its fraction
};

}  // namespace eyeray::render
