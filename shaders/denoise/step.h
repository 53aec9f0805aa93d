// The part of the ABI that denoising uses: its windows, its buffers, and the push constants of its kernels; by the rules of records.h.
#ifndef DENOISE_STEP_H
#define DENOISE_STEP_H
#include "language.h"

SHADER_BEGIN

#define WINDOW_RADIUS 6  // a pixel's neighbours: 13 × 13
#define PATCH_RADIUS 3   // two pixels are compared by the 7 × 7 around each
#define PATCH 7          // 2 · PATCH_RADIUS + 1
#define DENOISE_MARGIN 9 // WINDOW_RADIUS + PATCH_RADIUS

#define FEATURES 6     // albedo and normal
#define MOST_COLORS 4  // with an alpha

#define BINDING_COMPARED 0     // values that distances compare
#define BINDING_VARIANCES 1    // their variances
#define BINDING_COUNTING 2     // 1 for pixels that count, else 0
#define BINDING_DISTANCES 3    // differences of pixels, and then distances
#define BINDING_ROW_SUMS 4     // sums of a patch's row of differences
#define BINDING_VALUES 5       // values that are averaged or fitted
#define BINDING_FEATURES 6     // features without noise
#define BINDING_DENOISED 7     // results

// The push constants, 32 bytes. Inputs are planes of the tile with a margin of DENOISE_MARGIN pixels on each side; results are planes of the tile.
struct DenoiseStep {
  uint width;        // pixels of the tile, across
  uint height;       // … and down
  uint radius;       // radius of the window
  uint compared;     // the number of values that distances compare
  float least;       // added to variances
  float strictness;  // distances are multiplied by it
  uint first;        // the first plane of the results
  uint neighbour;    // the first neighbour of the dispatch
};

SHADER_END
#endif
