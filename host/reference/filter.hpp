// Pixel filters, in float64.
#pragma once

#include "host/scene/scene.hpp"

namespace eyeray::engine::reference {

// A random position drawn from the pixel filter, relative to the pixel's top left corner. `u`: a uniform
// random position in the pixel.
Vec2 filtered(const ImageSettings& image, const Vec2& u);

}  // namespace eyeray::engine::reference
