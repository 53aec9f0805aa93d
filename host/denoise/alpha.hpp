// The alpha of a denoised picture.
#pragma once

#include <functional>

#include "host/denoise/denoise.hpp"

namespace eyeray::engine::denoise {

// The denoised `color` with an alpha: `alpha_at(x, y)`, but at most 1, where the noisy alpha is between 0 and
// 1 at the pixel or beside it. Elsewhere the noisy alpha stays, and pixels that are not covered at all keep
// their noisy colour.
image::Image with_alpha(const NoisyPicture& picture, const image::Image& color,
                        const std::function<float(int x, int y)>& alpha_at);

}  // namespace eyeray::engine::denoise
