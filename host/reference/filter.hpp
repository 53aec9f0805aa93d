// Pixel filters, in float64.
#pragma once

#include "host/scene/scene.hpp"

namespace eyeray::engine::reference {

// A position in the pixel, from its top left corner, drawn from its filter by `u`, one drawn evenly.
Vec2 filtered(const ImageSettings& image, const Vec2& u);

}  // namespace eyeray::engine::reference
