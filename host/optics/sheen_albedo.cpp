#include "host/optics/sheen_albedo.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/optics/albedo_table.hpp"

namespace eyeray::optics {
namespace {

constexpr int turns = 16, heights = 64;
constexpr double step = 1.0 / (sheen_albedos - 1);

// Over the half sphere, half of all turns; heights as squares, most of them low, where sheen is.
template <typename Weakening>
double integral(double mu, double roughness, const Weakening& weakening) {
  const double level = std::sqrt(1 - mu * mu);
  double sum = 0;
  for (int k = 0; k < heights; ++k) {
    const double x = (k + 0.5) / heights, z = x * x, aside = std::sqrt(1 - z * z);
    double of_turns = 0;
    for (int t = 0; t < turns; ++t) {
      const double along = level + aside * std::cos(M_PI * (t + 0.5) / turns);
      const double across = aside * std::sin(M_PI * (t + 0.5) / turns), up = mu + z;
      const double length = std::sqrt(along * along + across * across + up * up);
      of_turns += sheen(std::min(up / length, 1.0), mu, z, roughness);
    }
    sum += of_turns * weakening(z) * z * (2 * x);
  }
  return sum * 2 * M_PI / (turns * heights);
}

std::array<SheenAlbedo, sheen_albedos * sheen_albedos> compute() {
  std::array<SheenAlbedo, sheen_albedos * sheen_albedos> table;
  for (int j = 0; j < sheen_albedos; ++j) {
    SheenAlbedo* row = &table[j * sheen_albedos];
    const auto mu = [](int i) { return std::max((i * step) * (i * step), 1e-6); };
    for (int i = 0; i < sheen_albedos; ++i)
      row[i].unweakened = integral(mu(i), j * step, [](double) { return 1; });
    for (int i = 0; i < sheen_albedos; ++i)
      row[i].albedo = integral(mu(i), j * step, [&](double z) {
        const double x = std::sqrt(z) / step;
        const int left = std::min(int(x), sheen_albedos - 2);
        const double there = std::lerp(row[left].unweakened, row[left + 1].unweakened, x - left);
        return 1 / std::max({1.0, row[i].unweakened, there});
      });
    const double mean = mean_by_cosine(sheen_albedos, [&](int i) { return row[i].albedo; });
    for (int i = 0; i < sheen_albedos; ++i) row[i].mean = mean;
  }
  return table;
}

}  // namespace

double sheen(double cosine_half_way, double cosine_o, double cosine_i, double roughness) {
  const double r = std::max(roughness, least_sheen_roughness), narrow = 1 / (r * r);
  const double fibres =
      (2 + narrow) * std::pow(std::sqrt(1 - cosine_half_way * cosine_half_way), narrow) / (2 * M_PI);
  return fibres / (4 * (cosine_i + cosine_o - cosine_i * cosine_o));
}

std::span<const SheenAlbedo> sheen_albedo_table() {
  static const auto table = compute();
  return table;
}

SheenAlbedo sheen_albedo(double cosine, double roughness) {
  const auto at = [&](double SheenAlbedo::*member) {
    return between(sheen_albedo_table(), sheen_albedos, cosine, roughness,
                   [&](const SheenAlbedo& of) { return of.*member; });
  };
  return {at(&SheenAlbedo::unweakened), at(&SheenAlbedo::albedo), at(&SheenAlbedo::mean)};
}

}  // namespace eyeray::optics
