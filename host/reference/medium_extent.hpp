// Lengths of rays in a medium that has an extent.
#pragma once

#include "host/scene/medium_extent.hpp"

namespace eyeray::engine::reference {

// The integral of the medium's density along the ray, whose direction is unit, from 0 to t. t may be
// infinite. Then the integral is infinite as well if the medium does not end.
double medium_length(const MediumExtent& extent, const Ray& ray, double t);
// The t at which medium_length() is `length`. `length` must be less than the integral along the whole ray.
double medium_distance(const MediumExtent& extent, const Ray& ray, double length);

}  // namespace eyeray::engine::reference
