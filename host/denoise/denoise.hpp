// Removes the noise of a picture by paths.
#pragma once

#include "host/denoise/stages.hpp"
#include "host/image/noisy_picture.hpp"

namespace eyeray::engine::denoise {

using image::DenoisedPicture;
using image::NoisyPicture;

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
//
// `stages` computes the stages that take long. Every choice has the same bits.
DenoisedPicture denoise(const NoisyPicture& picture, Stages& stages);
// The same by this machine's processor.
DenoisedPicture denoise(const NoisyPicture& picture);

}  // namespace eyeray::engine::denoise
