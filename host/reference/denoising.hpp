// Denoising in float64, written from the formulas of docs/denoising.md.
#pragma once

#include <array>
#include <vector>

#include "host/image/noisy_picture.hpp"

namespace eyeray::engine::reference {

// One pixel of the denoised picture.
struct DenoisedPixel {
  std::array<double, 4>
      color{};  // linear RGB; of a transparent picture, multiplied by the alpha that follows
  // The difference that the other one of the two fits would make, in each channel, where rounding may decide
  // between them; else 0.
  std::array<double, 4> doubt{};
  // True where rounding may decide whether a pixel near by counts, or which variance it has.
  bool undecided = false;
};

// The denoised picture, row by row.
std::vector<DenoisedPixel> denoise(const image::NoisyPicture& picture);

}  // namespace eyeray::engine::reference
