// Removes the noise of a picture by paths.
#pragma once

#include "host/image/image.hpp"

namespace eyeray::engine::denoise {

// The inputs of denoising: images of the same size. All but `samples` and `variance` are means over a pixel's
// samples, or over the first half of them (`half_…`, core/halves.hpp). Albedo and normal belong to the first
// surface that scatters light.
struct NoisyPicture {
  image::Image color;        // linear RGB
  image::Image half_color;   // linear RGB
  image::Image variance;     // the variance of `color`, that is of the mean, in 3 channels
  image::Image albedo;       // 3 channels, 0 to 1
  image::Image half_albedo;  // 3 channels
  image::Image normal;       // 3 channels
  image::Image half_normal;  // 3 channels
  image::Image samples;      // the number of the pixel's samples, in 1 channel
  // The alpha by which the colour is multiplied, in 1 channel; empty unless the picture is transparent.
  image::Image coverage;
  image::Image half_coverage;
};

struct DenoisedPicture {
  image::Image color;  // linear RGB; of a transparent picture, multiplied by an alpha that follows
  // An estimate of each pixel's error of luminance, in 1 channel: NaN where the colour is not finite. Blurred
  // details do not count. Empty if the denoiser estimates no errors.
  image::Image errors;
  // The mean of these errors over the pixels that were denoised, relative to their mean luminance.
  double error = 0;
};

// In a window around each pixel, the colour is a linear function of albedo and normal, found by weighted
// least squares. A neighbour has more weight, the less the two differ beyond their noise. Each half of the
// samples is fitted with weights from the other half, so that noise does not choose its own weights. The mean
// of the two is the result. Stricter and looser weights compete at each pixel: the fit counts that is nearer
// to the other half.
//
// An alpha is fitted as the colour is, with the same weights, so that edges stay consistent. Pixels that are
// covered wholly, as those around them are, stay so; the same holds for pixels that are not covered.
//
// Every block of 64 × 64 pixels keeps its mean brightness. Some pixels stay as they are: those that are not
// finite, have less than two samples, or are dots far brighter than their surroundings. The result does not
// depend on the number of threads.
//
// After Bitterli, Rousselle, Moon, Iglesias-Guitián, Adler, Mitchell, Jarosz and Novák, "Nonlinearly Weighted
// First-order Regression for Denoising Monte Carlo Renderings" (EGSR 2016).
DenoisedPicture denoise(const NoisyPicture& picture);

}  // namespace eyeray::engine::denoise
