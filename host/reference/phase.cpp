#include "host/reference/phase.hpp"

#include <cmath>

#include "host/reference/emitter_sample.hpp"

namespace eyeray::engine::reference {

double phase_value(double g, double cosine) {
  return (1 - g * g) / (4 * M_PI * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

Vec3 phase_direction(double g, const Vec3& before, const Vec2& u) {
  const double s = (1 - g * g) / (1 + g - 2 * g * u.x);
  const double cosine = std::abs(g) < 1e-6 ? 1 - 2 * u.x : (1 + g * g - s * s) / (2 * g);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const auto [x, y] = tangents(-before);
  const double angle = 2 * M_PI * u.y;
  return glm::normalize(sine * std::cos(angle) * x + sine * std::sin(angle) * y + cosine * before);
}

}  // namespace eyeray::engine::reference
