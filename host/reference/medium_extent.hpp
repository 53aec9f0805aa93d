// Lengths of rays in a medium that has an extent.
#pragma once

#include "host/scene/medium_extent.hpp"

namespace eyeray::engine::reference {

// The integral of the medium's density along the ray from 0 to t, which may be infinite, as the integral is
// then too where the medium does not end; d is unit.
double medium_length(const MediumExtent& extent, const Ray& ray, double t);
// The t at which that is `length`, which is less than the integral along the whole ray.
double medium_distance(const MediumExtent& extent, const Ray& ray, double length);

}  // namespace eyeray::engine::reference
