// GGX microfacets in float64, for surfaces whose z is the normal. They may be wider along x than along y.
// Walter, Marschner, Li, Torrance: Microfacet Models for Refraction through Rough Surfaces, EGSR 2007. Heitz:
// Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs, JCGT 2014. Dupuy, Benyoub: Sampling
// Visible GGX Normals with Spherical Caps, HPG 2023.
#pragma once

#include <algorithm>

#include "host/core/vec.hpp"

namespace eyeray::engine::reference {

class Facets {
 public:
  // `widths`: those of the slopes along x and y; 0: the square of `roughness`, at least 0.001.
  explicit Facets(double roughness, const Vec2& widths = Vec2(0))
      : widths_(widths.x > 0 ? widths : Vec2(std::max(roughness * roughness, 1e-3))) {}

  // The density of microfacets with normal h.
  double density(const Vec3& h) const;
  // Smith's Λ.
  double lambda(const Vec3& w) const;
  // Samples the normal of a microfacet that is visible from o.
  Vec3 normal(const Vec3& o, const Vec2& u) const;

  // True if the widths differ.
  bool uneven() const { return widths_.x != widths_.y; }
  // The share of light from w that microfacets, each a perfect mirror, reflect without another one in the
  // way; `edge`: weighted by Schlick's fifth power. By 64 of the microfacets that w sees, a lattice by the
  // golden ratio. w.z > 0.
  struct Once {
    double all = 0, edge = 0;
  };
  Once once(const Vec3& w) const;

  struct Reflection {
    double value = 0, density = 0;
  };
  // The light that microfacets, each a perfect mirror, reflect from i to o, times the cosine of i; and the
  // density with which i is sampled.
  Reflection reflection(const Vec3& o, const Vec3& i) const;

 private:
  Vec2 widths_;
};

}  // namespace eyeray::engine::reference
