// The light of a photographer's studio as a picture of all directions, which can light a scene.
#pragma once

#include "host/image/image.hpp"

namespace eyeray::engine::generate {

inline constexpr int most_studio_width = 4096;

// Equirectangular, of `width` × `width` / 2: a grey room with a soft box, a strip of light and a small area
// light. The same on every machine.
image::Image studio(int width);

}  // namespace eyeray::engine::generate
