#pragma once

#include "core/pixel.hpp"
#include "scene/scene.hpp"

namespace eyeray::reference {

// The colour of the first surface alone: lit without shadows, or, in a scene without lights, by a lamp at the
// eye.
PixelSample raycast(const Scene& scene, const Ray& ray);

}  // namespace eyeray::reference
