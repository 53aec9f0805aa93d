// Measures the light of a picture before it is rendered, for exposure = "auto".
#pragma once

#include "host/executors/executor.hpp"
#include "host/image/image.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::render {

// The exposure, in stops, that makes a picture's light 0.36 in the geometric mean, or less, so that no more
// than a tenth of it is beyond 1. `picture`: 3 channels, linear; a 4th is the alpha by
// which they are multiplied. What is averaged are the luminances of
// squares of 4 × 4 pixels, without the darkest and the brightest tenth, and without black ones. From −32 to
// 32; 0 if all is black. Reinhard et al., Photographic Tone Reproduction for Digital Images, SIGGRAPH 2002,
// equations 1 and 2, whose `a` is 0.36 for bright pictures.
double exposure_for(const image::Image& picture);

// Measures that exposure for the whole picture of `scene`, by one sample of every pixel of a coarse grid.
// Returns the exposure that the scene states, if it states one; 0 if it is interrupted, as the picture is
// then.
double metered_exposure(const Scene& scene, executors::Executor& executor);

}  // namespace eyeray::engine::render
