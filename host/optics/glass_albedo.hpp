// The directional albedo of rough glass, by quadrature.
// Turquin: Practical Multiple Scattering Compensation for Microfacet Models, 2019.
#pragma once

namespace eyeray::engine::optics {

// What GGX microfacets between two media mirror and refract without what another of them takes; cosine and
// roughness in [0, 1]. In steps so many times `finer` than usual.
double glass_albedo_integral(double cosine, double roughness, double ior_from, double ior_to, int finer = 1);

}  // namespace eyeray::engine::optics
