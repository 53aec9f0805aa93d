#pragma once

#include "host/core/pixel.hpp"
#include "host/reference/tracer.hpp"
#include "host/reference/whitted.hpp"

namespace eyeray::reference {

// The colour of the first surface alone: lit without shadows, or, in a scene without lights, by a lamp at the
// eye.
PixelSample raycast(const Tracer& tracer, const Ray& ray, const RayOffset& ray_offset = {});

}  // namespace eyeray::reference
