// How a point of a medium scatters light: Henyey, Greenstein: Diffuse Radiation in the Galaxy, Astrophysical
// Journal 93, 1941. g is the mean cosine of the angle by which light is turned.
#pragma once

#include "host/core/vec.hpp"

namespace eyeray::engine::reference {

// Of light that is turned by that angle: by solid angle, and its density too.
double phase_value(double g, double cosine);
// By that density, for light that came in direction `before`.
Vec3 phase_direction(double g, const Vec3& before, const Vec2& u);

}  // namespace eyeray::engine::reference
