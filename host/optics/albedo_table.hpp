// Tables of albedos: of as many rows by roughness as places in each by √cosine.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

namespace eyeray::optics {

// Between the places of a table, bilinear. number(entry): what is asked of it.
template <typename Entry, typename Number>
double between(std::span<const Entry> table, int side, double cosine, double roughness,
               const Number& number) {
  const double x = std::sqrt(std::clamp(cosine, 0.0, 1.0)) * (side - 1);
  const double y = std::clamp(roughness, 0.0, 1.0) * (side - 1);
  const auto i = size_t(std::min(x, side - 2.0)), j = size_t(std::min(y, side - 2.0));
  const auto row = [&](size_t k) {
    const Entry* near = &table[k * size_t(side) + i];
    return std::lerp(number(near[0]), number(near[1]), x - double(i));
  };
  return std::lerp(row(j), row(j + 1), y - double(j));
}

// 2 ∫ E(μ) μ dμ with μ = x²: 4 ∫ E x³ dx, E linear between the places of a row, albedo(i).
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

}  // namespace eyeray::optics
