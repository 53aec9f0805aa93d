// The arithmetic of shaders/denoise as C++, which the kernels share. Private to the denoiser.
#pragma once

#include "host/denoise/planes.hpp"

#include "shaders/records.h"

#include "host/core/local_shaders.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include "shaders/denoise/distance.glsl"
#include "shaders/denoise/regression.glsl"
#pragma GCC diagnostic pop

namespace eyeray::engine::denoise {

static_assert(window_radius == WINDOW_RADIUS && patch_radius == PATCH_RADIUS && margin == DENOISE_MARGIN);

}  // namespace eyeray::engine::denoise
