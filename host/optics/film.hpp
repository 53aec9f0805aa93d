// The light that a surface under a thin film mirrors: both sides of the film reflect light, which interferes.
#pragma once

#include "host/optics/fresnel.hpp"

namespace eyeray::engine::optics {

struct Film {
  double share = 0;      // the share of the surface that it covers; 0: there is no film
  double thickness = 0;  // in nanometres
  double ior = 1.3;

  // The reflectance, as linear sRGB in [0, 1], of a surface that reflects f0 at perpendicular incidence
  // without the film. `cosine`: that of the incident angle, in air. Belcour, Barla: A Practical Extension to
  // Microfacet Theory for the Modeling of Varying Iridescence, 2017, as in Khronos:
  // KHR_materials_iridescence: by Schlick's terms, with a real index for metals, and two orders of
  // interference.
  Vec3 reflectance(double cosine, const Vec3& f0) const;
  // The same for the share that it covers, and `bare`'s reflectance for the rest.
  Vec3 over(const Fresnel& bare, double cosine) const;
  // Schlick's curve through over() at that cosine. Its mean is over()'s mean over the half sphere.
  Fresnel seen(const Fresnel& bare, double cosine) const;
};

}  // namespace eyeray::engine::optics
