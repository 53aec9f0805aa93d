// The position of a pixel's sample in the picture: drawn from the pixel's filter, so that all samples count alike. Ernst, Stamminger and
// Greiner, "Filter Importance Sampling" (2006).
#ifndef FILTER_GLSL
#define FILTER_GLSL
#include "math/sampling.glsl"
#include "records.h"

SHADER_BEGIN

// The share of a Gaussian filter that its cut-off keeps: it ends at three standard deviations, where e^(−9/2) is left.
#define GAUSS_KEPT 0.98889100f

// A point even on a disk, then moved out to where the filter has the same share within. From the middle, in widths.
vec2 gaussian_point(vec2 u) {
  vec2 at = on_disk(u);
  float within = at.x * at.x + at.y * at.y;
  float r = sqrt(-2.0f * log_positive(maximum(1.0f - GAUSS_KEPT * within, 1.0f - GAUSS_KEPT))) / 6.0f;
  return at * (within > 0.0f ? r / sqrt(within) : 0.0f);
}

// The share of a Blackman–Harris filter within x widths of its middle, 0 ≤ x ≤ ½.
float blackman_harris_within(float x) {
  vec2 turn = sine_cosine(2.0f * PI * x);
  return 2.0f * x + turn.x * (0.43324748f + 0.12535420f * turn.y + 3.45445712e-3f * (4.0f * turn.y * turn.y - 1.0f));
}

// One coordinate from the middle, in widths, by halving.
float blackman_harris_coordinate(float u) {
  float side = 2.0f * u - 1.0f;
  float low = 0.0f;
  float high = 0.5f;
  for (uint i = 0u; i < 24u; i++) {
    float middle = 0.5f * (low + high);
    bool beyond = blackman_harris_within(middle) < abs(side);
    low = beyond ? middle : low;
    high = beyond ? high : middle;
  }
  return side < 0.0f ? -low : low;
}

// A point in the pixel, by the filter, from one drawn evenly.
vec2 filtered(Frame frame, vec2 u) {
  vec2 from_middle = u - vec2(0.5f, 0.5f);
  if (frame.pixel_filter == FILTER_GAUSSIAN) from_middle = gaussian_point(u);
  if (frame.pixel_filter == FILTER_BLACKMAN_HARRIS) from_middle = vec2(blackman_harris_coordinate(u.x), blackman_harris_coordinate(u.y));
  vec2 position = vec2(0.5f, 0.5f) + from_middle * frame.filter_width;
  return frame.pixel_filter == FILTER_BOX ? u : position;
}

SHADER_END
#endif
