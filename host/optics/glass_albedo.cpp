#include "host/optics/glass_albedo.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/vec.hpp"
#include "host/optics/fresnel.hpp"

namespace eyeray::optics {
namespace {

constexpr int least_turns = 24, least_heights = 72;
double lambda(double cosine, double width) {
  const double slope = (1 - cosine * cosine) / (cosine * cosine);
  return (std::sqrt(1 + width * width * slope) - 1) / 2;
}

}  // namespace

// Over the normals that are seen, as ggx_albedo_integral().
double glass_albedo_integral(double cosine, double roughness, double ior_from, double ior_to, int finer) {
  const int turns = least_turns * finer, heights = least_heights * finer;
  const double width = std::max(roughness * roughness, 1e-6), mu = std::max(cosine, 1e-6);
  const double ratio = ior_from / ior_to;
  const Vec3 o(std::sqrt(1 - mu * mu), 0, mu);
  const Vec3 v = glm::normalize(Vec3(width * o.x, 0, o.z));
  const double here = 1 + lambda(mu, width);
  double sum = 0;
  for (int t = 0; t < turns; ++t) {
    const double c = std::cos(M_PI * (t + 0.5) / turns), s = std::sin(M_PI * (t + 0.5) / turns);
    for (int k = 0; k < heights; ++k) {
      const double x = (k + 0.5) / heights * (1 + v.z);
      const double radius = std::sqrt(x * (2 - x));
      const Vec3 h = glm::normalize(Vec3(width * (radius * c + v.x), width * (radius * s), 1 - x + v.z));
      const double along = std::min(glm::dot(o, h), 1.0);
      const double mirrored = dielectric_reflectance(along, ior_from, ior_to);
      const double up = 2 * along * h.z - o.z;
      if (up > 0) sum += mirrored * here / (here + lambda(std::min(up, 1.0), width));
      if (mirrored == 1) continue;
      const double beyond = std::sqrt(std::max(0.0, 1 - ratio * ratio * (1 - along * along)));
      const double down = ratio * o.z - (ratio * along - beyond) * h.z;
      if (down > 0) sum += (1 - mirrored) * here / (here + lambda(std::min(down, 1.0), width));
    }
  }
  return sum / (turns * heights);
}

}  // namespace eyeray::optics
