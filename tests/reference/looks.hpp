// Materials `principled` for tests, and their BSDFs in the reference.
#pragma once

#include <fmt/format.h>

#include <cmath>

#include "host/loader/scene_file.hpp"
#include "host/scene/bsdf.hpp"

namespace eyeray::engine::test {

struct Look {
  double metallic = 0, transmission = 0, roughness = 0.5, coat = 0, sheen = 0, color = 1, specular = 1;
  bool thin = false;
  double ior = 1.5, coat_roughness = 0.3, sheen_roughness = 0.5;
  double diffuse_transmission = 0, anisotropy = 0, iridescence = 0;
};

// The BSDF for a ray that leaves the shape, or for one that enters.
inline Bsdf bsdf_of(const Look& look, double cosine, bool leaving = false) {
  const Scene scene = loader::parse_scene(
      fmt::format(R"(
[camera]
eye = [0, 0, 5]
target = [0, 0, 0]
[[light]]
type = "point"
position = [0, 5, 5]
[render]
integrator = "path"
[[material]]
name = "m"
type = "principled"
color = {}
metallic = {}
roughness = {}
ior = {}
specular = {}
transmission = {}
coat = {}
coat_roughness = {}
sheen_color = {}
sheen_roughness = {}
thin = {}
diffuse_transmission = {}
anisotropy = {}
iridescence = {}
[[sphere]]
material = "m"
center = [0, 0, 0]
radius = 1
)",
                  look.color, look.metallic, look.roughness, look.ior, look.specular, look.transmission,
                  look.coat, look.coat_roughness, look.sheen, look.sheen_roughness, look.thin,
                  look.diffuse_transmission, look.anisotropy, look.iridescence),
      "scene.toml");
  const Material& material = *scene.materials.back();
  const ScatteringContext context{.point = {},
                                  .cos_view = cosine,
                                  .ior_from = leaving ? look.ior : 1,
                                  .ior_to = leaving || look.thin || look.transmission == 0 ? 1 : look.ior};
  return material.bsdf(context, material.scattering(context));
}

inline Vec3 direction_of(double cosine) {
  return {std::sqrt(1 - cosine * cosine), 0, cosine};
}

}  // namespace eyeray::engine::test
