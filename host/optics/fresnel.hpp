// The share of light that a smooth surface mirrors, by the cosine of its angle to the normal.
#pragma once

#include "host/core/vec.hpp"

namespace eyeray::engine::optics {

// Schlick's reflectance, from f0 at perpendicular incidence to f90 at grazing incidence (An Inexpensive BRDF
// Model for Physically-Based Rendering, 1994), or the reflectance of a metal of refractive index f0 + i f90.
struct Fresnel {
  Vec3 f0{0};
  Vec3 f90{0};
  Vec3 mean{0};  // over the half sphere, weighted by cosine
  bool conductor = false;

  Vec3 at(double cosine) const;
};

Fresnel schlick(const Vec3& f0, const Vec3& f90);
// A metal of refractive index n + ik, n > 0, k ≥ 0. Born, Wolf: Principles of Optics, 14.2.
Fresnel conductor(const Vec3& n, const Vec3& k);

// Reflectance in [0, 1] of unpolarised light at the boundary from index n1 to n2. `cosine`: that of the
// incident angle. Born, Wolf: Principles of Optics, 1.5.
double dielectric_reflectance(double cosine, double n1, double n2);

}  // namespace eyeray::engine::optics
