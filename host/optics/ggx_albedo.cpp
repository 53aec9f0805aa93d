#include "host/optics/ggx_albedo.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/vec.hpp"
#include "host/optics/mean_by_cosine.hpp"

namespace eyeray::optics {
namespace {

constexpr int turns = 16, heights = 96;

double lambda(double cosine, double width) {
  const double slope = (1 - cosine * cosine) / (cosine * cosine);
  return (std::sqrt(1 + width * width * slope) - 1) / 2;
}

}  // namespace

// Over the normals that are seen (Dupuy, Benyoub: Sampling Visible GGX Normals with Spherical Caps, 2023), a
// cap of the sphere: by angle, where half will do, and by height, both in midpoints.
GgxAlbedo ggx_albedo_integral(double cosine, double roughness) {
  const double width = std::max(roughness * roughness, 1e-6), mu = std::max(cosine, 1e-6);
  const Vec3 o(std::sqrt(1 - mu * mu), 0, mu);
  const Vec3 v = glm::normalize(Vec3(width * o.x, 0, o.z));
  const double here = 1 + lambda(mu, width);
  double once = 0, edge = 0;
  for (int t = 0; t < turns; ++t) {
    const double c = std::cos(M_PI * (t + 0.5) / turns), s = std::sin(M_PI * (t + 0.5) / turns);
    for (int k = 0; k < heights; ++k) {
      const double x = (k + 0.5) / heights * (1 + v.z);
      const double radius = std::sqrt(x * (2 - x));
      const Vec3 h = glm::normalize(Vec3(width * (radius * c + v.x), width * (radius * s), 1 - x + v.z));
      const double along = std::min(glm::dot(o, h), 1.0);
      const double down = 2 * along * h.z - o.z;
      if (!(down > 0)) continue;
      const double share = here / (here + lambda(std::min(down, 1.0), width));
      once += share;
      edge += share * std::pow(1 - along, 5);
    }
  }
  return {once / (turns * heights), edge / (turns * heights), 0, 0};
}

std::vector<GgxAlbedo> ggx_albedo_row(int places, double roughness) {
  std::vector<GgxAlbedo> row;
  const double step = 1.0 / (places - 1);
  for (int i = 0; i < places; ++i) row.push_back(ggx_albedo_integral((i * step) * (i * step), roughness));
  const double once = mean_by_cosine(places, [&](int i) { return row[size_t(i)].once; });
  const double edge = mean_by_cosine(places, [&](int i) { return row[size_t(i)].edge; });
  for (GgxAlbedo& albedo : row) {
    albedo.mean_once = once;
    albedo.mean_edge = edge;
  }
  return row;
}

}  // namespace eyeray::optics
