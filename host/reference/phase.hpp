// The phase function of a medium: Henyey, Greenstein: Diffuse Radiation in the Galaxy, Astrophysical Journal
// 93, 1941. g is the mean cosine of the angle by which light is deflected.
#pragma once

#include "host/core/vec.hpp"

namespace eyeray::engine::reference {

// The phase function per solid angle, for light deflected by the angle with that cosine. It is also the
// density of phase_direction.
double phase_value(double g, double cosine);
// Samples a direction with the density phase_value, for light that travelled in direction `before`.
Vec3 phase_direction(double g, const Vec3& before, const Vec2& u);

}  // namespace eyeray::engine::reference
