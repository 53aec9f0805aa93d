#include "host/reference/light.hpp"

#include <limits>

namespace eyeray::reference {

Illumination illuminate(const Light& light, const Vec3& point) {
  if (light.type == LightType::directional)
    return {light.to_light, light.intensity, std::numeric_limits<double>::infinity()};
  const Vec3 to_light = light.position - point;
  const double distance = glm::length(to_light);
  const bool falls_off = light.falloff == Falloff::inverse_square;
  return {to_light / distance, falls_off ? light.intensity / (distance * distance) : light.intensity,
          distance};
}

}  // namespace eyeray::reference
