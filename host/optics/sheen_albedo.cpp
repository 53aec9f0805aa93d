#include "host/optics/sheen_albedo.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray::engine::optics {
namespace {

constexpr int sheen_turns = 16, sheen_heights = 64;

// Integrates over the half sphere. Half of all angles around the normal suffice. Heights are squares, so that
// most of them are low, where sheen is.
template <typename Weakening>
double integral(double mu, double roughness, const Weakening& weakening) {
  const double level = std::sqrt(1 - mu * mu);
  double sum = 0;
  for (int k = 0; k < sheen_heights; ++k) {
    const double x = (k + 0.5) / sheen_heights, z = x * x, sine = std::sqrt(1 - z * z);
    double of_turns = 0;
    for (int t = 0; t < sheen_turns; ++t) {
      const double along = level + sine * std::cos(M_PI * (t + 0.5) / sheen_turns);
      const double across = sine * std::sin(M_PI * (t + 0.5) / sheen_turns), up = mu + z;
      const double length = std::sqrt(along * along + across * across + up * up);
      of_turns += sheen(std::min(up / length, 1.0), mu, z, roughness);
    }
    sum += of_turns * weakening(z) * z * (2 * x);
  }
  return sum * 2 * M_PI / (sheen_turns * sheen_heights);
}

}  // namespace

double sheen(double cosine_half_way, double cosine_o, double cosine_i, double roughness) {
  const double r = std::max(roughness, least_sheen_roughness), narrow = 1 / (r * r);
  const double fibres =
      (2 + narrow) * std::pow(std::sqrt(1 - cosine_half_way * cosine_half_way), narrow) / (2 * M_PI);
  return fibres / (4 * (cosine_i + cosine_o - cosine_i * cosine_o));
}

std::vector<SheenAlbedo> sheen_albedo_row(int count, double roughness) {
  std::vector<SheenAlbedo> row(static_cast<size_t>(count));
  const double step = 1.0 / (count - 1);
  const auto of_each = [&](double SheenAlbedo::* member, const auto& weakening) {
    for (int i = 0; i < count; ++i) {
      SheenAlbedo& at = row[size_t(i)];
      at.*member = integral(std::max((i * step) * (i * step), 1e-6), roughness,
                            [&](double z) { return weakening(at, z); });
    }
  };
  of_each(&SheenAlbedo::unweakened, [](const SheenAlbedo&, double) { return 1.0; });
  of_each(&SheenAlbedo::albedo, [&](const SheenAlbedo& here, double z) {
    const double x = std::sqrt(z) / step;
    const int left = std::min(int(x), count - 2);
    const SheenAlbedo* near = &row[size_t(left)];
    const double there = std::lerp(near[0].unweakened, near[1].unweakened, x - left);
    return 1 / std::max({1.0, here.unweakened, there});
  });
  return row;
}

}  // namespace eyeray::engine::optics
