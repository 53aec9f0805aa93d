// A picture with noise, and all that is known about its noise.
#pragma once

#include "host/image/image.hpp"

namespace eyeray::engine::image {

// The inputs of denoising: images of the same size. All but `samples` and `variance` are means over a pixel's
// samples, or over the first half of them (`half_…`, core/halves.hpp). Albedo and normal belong to the first
// surface that scatters light.
struct NoisyPicture {
  Image color;        // linear RGB
  Image half_color;   // linear RGB
  Image variance;     // the variance of `color`, that is of the mean, in 3 channels
  Image albedo;       // 3 channels, 0 to 1
  Image half_albedo;  // 3 channels
  Image normal;       // 3 channels
  Image half_normal;  // 3 channels
  Image samples;      // the number of the pixel's samples, in 1 channel
  // The alpha by which the colour is multiplied, in 1 channel; empty unless the picture is transparent.
  Image coverage;
  Image half_coverage;
};

struct DenoisedPicture {
  Image color;  // linear RGB; of a transparent picture, multiplied by an alpha that follows
  // An estimate of each pixel's error of luminance, in 1 channel: NaN where the colour is not finite. Blurred
  // details do not count. Empty if the denoiser estimates no errors.
  Image errors;
  // The mean of these errors over the pixels that were denoised, relative to their mean luminance.
  double error = 0;
};

}  // namespace eyeray::engine::image
