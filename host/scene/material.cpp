#include "host/scene/material.hpp"

namespace eyeray::engine {

// A diffuse albedo above 1 would make light without end. Keys limit the other terms to 1.
Bsdf Material::bsdf(const ScatteringContext&, const Scattering& scattering) const {
  return {.diffuse = glm::min(scattering.diffuse, Vec3(1)),
          .mirror = scattering.reflected,
          .transmitted = scattering.transmitted};
}

}  // namespace eyeray::engine
