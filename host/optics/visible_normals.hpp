// The GGX microfacets that are visible from one direction, for integrals over them.
#pragma once

#include <algorithm>
#include <cmath>

#include "host/core/vec.hpp"

namespace eyeray::engine::optics {

class VisibleNormals {
 public:
  // `roughness`: the surface's. `cosine`: between the surface's normal, which is z, and the viewer.
  VisibleNormals(double cosine, double roughness)
      : width_(std::max(roughness * roughness, 1e-6)), cosine_(std::max(cosine, 1e-6)) {}

  // The unit vector towards the viewer.
  Vec3 viewer() const { return {std::sqrt(1 - cosine_ * cosine_), 0, cosine_}; }

  // A microfacet scatters light at this cosine to the surface's normal. Returns the share of that light that
  // no other microfacet blocks.
  double leaving(double cosine) const {
    const double here = 1 + lambda(cosine_);
    return here / (here + lambda(std::min(cosine, 1.0)));
  }

  // The mean of of_normal(h, cosine between viewer and h) over turns × heights microfacets, weighted by their
  // visibility. They are midpoints of a spherical cap, in steps of angle and height; half of all angles
  // suffice (Dupuy, Benyoub: Sampling Visible GGX Normals with Spherical Caps, 2023). of_normal's results
  // must support += and division by a number.
  template <typename OfNormal>
  auto mean(int turns, int heights, const OfNormal& of_normal) const {
    const Vec3 o = viewer(), v = glm::normalize(Vec3(width_ * o.x, 0, o.z));
    decltype(of_normal(o, 1.0)) sum{};
    for (int t = 0; t < turns; ++t) {
      const double c = std::cos(M_PI * (t + 0.5) / turns), s = std::sin(M_PI * (t + 0.5) / turns);
      for (int k = 0; k < heights; ++k) {
        const double x = (k + 0.5) / heights * (1 + v.z);
        const double radius = std::sqrt(x * (2 - x));
        const Vec3 h = glm::normalize(Vec3(width_ * (radius * c + v.x), width_ * (radius * s), 1 - x + v.z));
        sum += of_normal(h, std::min(glm::dot(o, h), 1.0));
      }
    }
    return sum / double(turns * heights);
  }

 private:
  double lambda(double cosine) const {
    const double slope = (1 - cosine * cosine) / (cosine * cosine);
    return (std::sqrt(1 + width_ * width_ * slope) - 1) / 2;
  }

  double width_, cosine_;
};

}  // namespace eyeray::engine::optics
