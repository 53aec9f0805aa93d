#include "host/optics/ggx_albedo.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/parallel_for.hpp"
#include "host/core/vec.hpp"

namespace eyeray::optics {
namespace {

constexpr int turns = 16, heights = 96;

double lambda(double cosine, double width) {
  const double slope = (1 - cosine * cosine) / (cosine * cosine);
  return (std::sqrt(1 + width * width * slope) - 1) / 2;
}

std::array<GgxAlbedo, ggx_albedos * ggx_albedos> compute() {
  std::array<GgxAlbedo, ggx_albedos * ggx_albedos> table;
  constexpr double step = 1.0 / (ggx_albedos - 1);
  parallel_for(0, ggx_albedos, [&](int j) {
    GgxAlbedo* row = &table[j * ggx_albedos];
    for (int i = 0; i < ggx_albedos; ++i) row[i] = ggx_albedo_integral((i * step) * (i * step), j * step);
    // 2 ∫ E(μ) μ dμ with μ = x²: 4 ∫ E x³ dx, E linear between the table's places.
    GgxAlbedo mean{};
    for (int i = 0; i + 1 < ggx_albedos; ++i) {
      const double a = i * step, b = a + step;
      const double whole = (b * b * b * b - a * a * a * a);
      const double right = (4.0 / 5 * (std::pow(b, 5) - std::pow(a, 5)) - a * whole) / step;
      mean.mean_once += row[i].once * (whole - right) + row[i + 1].once * right;
      mean.mean_edge += row[i].edge * (whole - right) + row[i + 1].edge * right;
    }
    for (int i = 0; i < ggx_albedos; ++i) {
      row[i].mean_once = mean.mean_once;
      row[i].mean_edge = mean.mean_edge;
    }
  });
  return table;
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

std::span<const GgxAlbedo> ggx_albedo_table() {
  static const auto table = compute();
  return table;
}

GgxAlbedo ggx_albedo(double cosine, double roughness) {
  const auto table = ggx_albedo_table();
  const double x = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (ggx_albedos - 1);
  const double y = std::clamp(roughness, 0.0, 1.0) * (ggx_albedos - 1);
  const auto i = size_t(std::min(x, ggx_albedos - 2.0)), j = size_t(std::min(y, ggx_albedos - 2.0));
  const GgxAlbedo* near = &table[j * ggx_albedos + i];
  const auto between = [&](double GgxAlbedo::*member) {
    const double low = std::lerp(near[0].*member, near[1].*member, x - double(i));
    const double high = std::lerp(near[ggx_albedos].*member, near[ggx_albedos + 1].*member, x - double(i));
    return std::lerp(low, high, y - double(j));
  };
  return {between(&GgxAlbedo::once), between(&GgxAlbedo::edge), between(&GgxAlbedo::mean_once),
          between(&GgxAlbedo::mean_edge)};
}

}  // namespace eyeray::optics
