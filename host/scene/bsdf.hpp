// A surface's BSDF at a point, as its material sets it: which lobes there are, and how strong. Their
// definitions are in reference/bsdf.hpp, and in shaders/bsdf.
#pragma once

#include "host/optics/film.hpp"
#include "host/optics/fresnel.hpp"

namespace eyeray::engine {

struct Bsdf {
  Vec3 diffuse{0};  // albedo, under `layer`
  double diffuse_roughness = 0;
  optics::Fresnel layer = {};  // crossed by light on its way to the diffuse lobe and back
  double layered = 1;          // the share of the surface that mirrors by `layer`
  optics::Fresnel metal = {};
  double metallic = 0;     // the share of the surface that mirrors by `metal`
  double roughness = 1;    // roughness of `layer`, `metal`, `glass` and `thin`
  Vec2 widths{0};          // widths of the slopes of those microfacets along x and y; 0: by `roughness`
  optics::Film film = {};  // over `layer` and `metal`
  double coat = 0;         // the share of the surface that is coated
  double coat_roughness = 1;
  Vec3 coat_normal{0, 0, 1};  // in the surface's own frame
  Vec3 sheen{0};              // colour of the fibres, above all other layers but the coat
  double sheen_roughness = 1;
  Vec3 thin{0};         // throughput of a rough pane, under `layer`
  Vec3 translucent{0};  // albedo for light that comes through the body evenly, under `layer`
  Vec3 glass{0};        // throughput of rough glass, before Fresnel
  Vec3 glass_color{1};  // further factor of light that rough glass refracts
  double ior_from = 1;  // index of the medium on the viewer's side of rough glass
  double ior_to = 1;    // index of the medium on the other side
  Vec3 mirror{0};       // throughput of the mirrored direction
  Vec3 transmitted{0};  // throughput of the refracted direction
  Vec3 passed{0};       // throughput of light that goes straight through a pane, under `layer`
  Vec3 crossed{0};      // throughput of light that goes straight through an interface
};

}  // namespace eyeray::engine
