// The cosine-weighted mean over the half sphere of a function that is known at even steps of √cosine.
#pragma once

#include <cmath>

namespace eyeray::engine::optics {

// Computes 2 ∫ E(μ) μ dμ, which is 4 ∫ E x³ dx with μ = x². E is linear between the `side`
// entries albedo(i) of a row.
template <typename Albedo>
double mean_by_cosine(int side, const Albedo& albedo) {
  const double step = 1.0 / (side - 1);
  double mean = 0;
  for (int i = 0; i + 1 < side; ++i) {
    const double a = i * step, b = a + step;
    const double whole = b * b * b * b - a * a * a * a;
    const double right = (4.0 / 5 * (std::pow(b, 5) - std::pow(a, 5)) - a * whole) / step;
    mean += albedo(i) * (whole - right) + albedo(i + 1) * right;
  }
  return mean;
}

}  // namespace eyeray::engine::optics
