#include "host/scene/material.hpp"

namespace eyeray::engine {

// More would be light without end.
Bsdf Material::bsdf(const ScatteringContext&, const Scattering& scattering) const {
  return {.diffuse = glm::min(scattering.diffuse, Vec3(1)),
          .mirror = scattering.reflected,
          .transmitted = scattering.transmitted};
}

}  // namespace eyeray::engine
