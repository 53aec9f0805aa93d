// The mean over the half sphere, by cosine, of a function known at steps of √cosine.
#pragma once

#include <cmath>

namespace eyeray::engine::optics {

// 2 ∫ E(μ) μ dμ with μ = x²: 4 ∫ E x³ dx, E linear between the entries of a row, albedo(i).
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
