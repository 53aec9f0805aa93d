#include "host/reference/light_disk.hpp"

#include <cmath>

#include "host/reference/emitter_sample.hpp"

namespace eyeray::engine::reference {

namespace {

// 1 − the cosine of the angle from the disk's middle to its rim.
double versine(const Illumination& light) {
  return 2 * std::pow(std::sin(light.angle / 2), 2);
}

}  // namespace

// A floor under the light receives π · color. From a disk of radiance 1 right above, it would receive π ·
// sin²(angle).
Vec3 disk_radiance(const Illumination& light) {
  return light.color / std::pow(std::sin(light.angle), 2);
}

double disk_density(const Illumination& light) {
  return 1 / (2 * M_PI * versine(light));
}

Vec3 disk_direction(const Illumination& light, const Vec2& u) {
  const double cosine = 1 - u.x * versine(light), turn = 2 * M_PI * u.y;
  const auto [s, t] = tangents(light.l);
  return cosine * light.l +
         std::sqrt((1 - cosine) * (1 + cosine)) * (std::cos(turn) * s + std::sin(turn) * t);
}

bool in_disk(const Illumination& light, const Vec3& d) {
  return glm::length(glm::cross(d, light.l)) < std::sin(light.angle) && glm::dot(d, light.l) > 0;
}

}  // namespace eyeray::engine::reference
