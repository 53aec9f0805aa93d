// BSDFs in float64: the sum of all lobes for a direction, and the sampling of directions. Directions are unit
// vectors in the surface's own frame, whose z is the normal on the viewer's side.
#pragma once

#include "host/optics/ggx_albedo.hpp"
#include "host/reference/facets.hpp"
#include "host/reference/local_frame.hpp"
#include "host/scene/bsdf.hpp"

namespace eyeray::engine::reference {

struct BsdfValue {
  Vec3 value{0};       // BSDF · |cosine of the light|, for radiance / index²
  double density = 0;  // with which sample() chooses that direction, by solid angle
};

struct BsdfSample {
  enum class Kind { lobe, mirrored, refracted, passed };
  Kind kind;
  Vec3 i;         // for a lobe the direction from which light may come; 0 if the surface itself blocks it
  Vec3 weight;    // for a single direction throughput / probability; without layers, unless passed
  uint32_t lobe;  // its number in the shaders
};

// A BSDF towards one viewer.
class ViewedBsdf {
 public:
  // o: towards the viewer, o.z > 0.
  ViewedBsdf(const Bsdf& bsdf, const Vec3& o) : ViewedBsdf(bsdf, o, false) {}

  // The value for light from i, summed over all lobes except the single directions (mirrored, refracted,
  // passed). `before`: true if the light is in front of the surface. A lobe does not count if its normal,
  // which may be bent, puts the light on the other side.
  BsdfValue at(const Vec3& i, bool before) const;
  // True if any lobe counts for light from i.
  bool faces(const Vec3& i, bool before) const;
  // `random` and u: random numbers in [0, 1). The BSDF must not be black.
  BsdfSample sample(double random, const Vec2& u) const;
  // The BSDF's wide lobes alone, or its sharp ones alone. Each lobe keeps the probability that it has in the
  // whole BSDF (shaders/bsdf/parts.glsl).
  ViewedBsdf part(bool wide) const;
  // The probability that one of its lobes is followed: 1, or less for a partial BSDF.
  double followed() const;
  // The share of light that goes straight on.
  Vec3 passed() const { return passed_; }
  // About the share of light that the BSDF scatters towards the viewer.
  Vec3 albedo() const { return glm::min(albedo_, Vec3(1)); }
  // True if light leaves in single directions alone.
  bool specular() const { return shares_[mirror] + shares_[transmitted] + shares_[straight] > 0 && !rough(); }
  // The BSDF for photons, which come from o and are weighed by the surface's normal.
  ViewedBsdf adjoint() const { return {bsdf_, o_, true}; }
  // The share of light that coat and sheen leave, for light in the mirrored or the refracted direction i.
  double through_layers(const Vec3& i) const;
  // True if it scatters no light at all.
  bool black() const { return sum_ == 0; }

 private:
  ViewedBsdf(const Bsdf& bsdf, const Vec3& o, bool adjoint);

  // The lobes, in the order in which they are chosen.
  enum Lobe {
    diffuse,
    glossy,
    multiple,
    coat,
    glass,
    sheen,
    thin,
    translucent,
    mirror,
    transmitted,
    straight,
    lobes
  };

  bool rough() const {
    double sum = 0;
    for (int lobe = diffuse; lobe < mirror; ++lobe) sum += shares_[lobe];
    return sum > 0;
  }
  BsdfValue value(Lobe lobe, const Vec3& i) const;
  // The share of light left by each layer when light crosses it in direction w, in front of the surface.
  struct Layers {
    double coat, sheen;
  };
  Layers layers(const Vec3& w) const;
  Layers layers_between(const Vec3& i) const;
  Vec3 direction(Lobe lobe, double part, const Vec2& u) const;

  // The albedo of the body's microfacets for light from w, on either side.
  optics::GgxAlbedo albedo_of(const Vec3& w) const;
  // The layer's albedo for light on its way into the body in direction w and out to the viewer, over that of
  // the body itself.
  Vec3 through_layer(const Vec3& w) const;

  const Bsdf& bsdf_;
  Vec3 o_;
  optics::Fresnel layer_, metal_;  // those of bsdf_, as its film makes them towards the viewer
  Facets facets_;
  Facets::Once once_o_;  // the viewer's, if facets_ are uneven
  LocalFrame coat_;
  Vec3 coat_o_;  // o_ in the frame coat_
  bool adjoint_;
  double shares_[lobes] = {};
  double sum_ = 0;
  Vec3 albedo_{0};
  Vec3 passed_;
};

}  // namespace eyeray::engine::reference
