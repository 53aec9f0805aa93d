// The distance between two pixels, by the patches around both (docs/denoising.md).
//
// After Rousselle, Manzi and Zwicker, "Robust Denoising using Feature and Color Information" (2013), section 3. A squared difference, less the part
// that noise adds, is divided by the noise. The mean over the patch is the distance. Two things differ from there. The noise of the neighbour counts
// only up to that of the pixel, so one without noise accepts no noisy neighbour that differs. The pixels themselves count for at least a quarter, so
// edges stay sharp.
#ifndef DENOISE_DISTANCE_GLSL
#define DENOISE_DISTANCE_GLSL
#include "math/math.glsl"

#include "denoise/lanes.h"
#include "denoise/step.h"

SHADER_BEGIN

// The difference of two values with their variances; `least` is added to both variances.
IN_CALLER float patch_difference(float here, float there, float variance_here, float variance_there, float least) {
  float apart = here - there;
  float noise = variance_here + minimum(variance_here, variance_there);
  return (apart * apart - noise) / (least + noise);
}

// The share of one difference in the mean over a patch of pixels with so many values each, and in that over the pixel's own values.
IN_CALLER float share_of_patch(int values) { return 1.0f / float(values * PATCH * PATCH); }
IN_CALLER float share_of_own(int values) { return 0.25f / float(values); }

// The distance from the patch's mean and from that of the pixels alone. `counts`: 0 for a neighbour that does not count, else 1.
IN_CALLER float patch_distance(float mean, float own_mean, float counts) {
  float distance = maximum(0.0f, maximum(mean, own_mean));
  return distance + (1.0f - counts) * 1.0e30f;
}

// The weight of a neighbour at distance x: exp(−x) to 0.03, and 0 from 16 on.
IN_CALLER float neighbour_weight(float x) {
  float part = maximum(0.0f, 1.0f - x * 0.0625f);
  float square = part * part;
  float fourth = square * square;
  float eighth = fourth * fourth;
  return eighth * eighth;
}

// Half of a weighted mean, by its sum. The sum of the weights starts from LEAST_WEIGHT, so that it is never 0.
#define LEAST_WEIGHT 1.0e-20f
IN_CALLER float half_of_mean(float sum, float weights) { return 0.5f * sum / weights; }

SHADER_END
#endif
