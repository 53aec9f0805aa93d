// The sRGB transfer curve of IEC 61966-2-1: linear segment and power, never a plain power.
#pragma once

#include <cmath>

namespace eyeray::engine::image {

// Linear light in [0, 1] to an sRGB value in [0, 1].
inline double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

// The inverse: an sRGB value in [0, 1] to linear light in [0, 1].
inline double linear_from_srgb(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

}  // namespace eyeray::engine::image
