#include "host/materials/physical.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::materials {

PhongValues stand_in(const TexturePtr& body, const Vec3& f0, double roughness) {
  const double smooth = (1 - roughness) * (1 - roughness);
  const double exponent = std::clamp(2 / std::max(1e-4, std::pow(roughness, 4)) - 2, 1.0, 10000.0);
  const Vec3 lobe = glm::min(f0 * ((exponent + 2) / 8), Vec3(1));
  return {.diffuse = body,
          .reflectance = textures::make_constant(f0 * smooth),
          .highlight = {textures::make_constant(lobe), exponent, true}};
}

double typical(const Texture& texture) {
  return texture.constant().value_or(texture.at(Vec2(0.5))).y;
}

}  // namespace eyeray::engine::materials
