// Whitted: An Improved Illumination Model for Shaded Display, CACM 23(6), 1980; recursive, as the paper has
// it.
#pragma once

#include "core/pixel.hpp"
#include "reference/media.hpp"
#include "reference/tracer.hpp"

namespace eyeray::reference {

// What `ray` (with a unit direction) sees, starting in `media`. Rays leave surfaces at least `clearance` off,
// as a share of |n|·|position − eye|.
PixelSample whitted(const Tracer& tracer, const Ray& ray, const MediaStack& media, double clearance = 0);

}  // namespace eyeray::reference
