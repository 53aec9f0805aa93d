// The directional albedo of rough glass, by quadrature.
// Turquin: Practical Multiple Scattering Compensation for Microfacet Models, 2019.
#pragma once

namespace eyeray::engine::optics {

// The share of light that GGX microfacets between two media reflect and refract, without the light that
// another microfacet blocks. Cosine and roughness are in [0, 1]. The quadrature's steps are `finer`
// times finer than usual.
double glass_albedo_integral(double cosine, double roughness, double ior_from, double ior_to, int finer = 1);

}  // namespace eyeray::engine::optics
