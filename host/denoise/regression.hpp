// Fits colours in windows by linear functions of features.
#pragma once

#include "host/denoise/distances.hpp"
#include "host/denoise/stages.hpp"

namespace eyeray::engine::denoise {

// Fits the `colors`, at most 4 planes, in the window of each pixel of a tile as a linear function of
// `features`, by weighted least squares. (x, y): the tile's first pixel. Writes to `fitted` the function's
// value at the pixel, 0 or more. A neighbour's weight is neighbour_weight(strictness · distance)
// (shaders/denoise/distance.glsl). A coefficient costs, so that features which hardly change in the window do
// not count.
void fit_tile(const Planes& colors, const Planes& features, const Distances& distances, float strictness,
              int x, int y, Planes& fitted);

// Adds half of each pixel's weighted mean of its neighbours' `values` to `means`, by the same weights with
// strictness 1.
void average_tile(const Planes& values, const Distances& distances, int x, int y, Planes& means);

}  // namespace eyeray::engine::denoise
