#include "host/shapes/chebyshev.hpp"

#include <cmath>
#include <numbers>

namespace eyeray::engine::shapes {

namespace {

constexpr int degree = ChebyshevSeries::degree;

// cos(π·i·k / degree): the value of the k-th polynomial at the i-th point.
const std::array<std::array<double, degree + 1>, degree + 1>& cosines() {
  static const auto table = [] {
    std::array<std::array<double, degree + 1>, degree + 1> all;
    for (int i = 0; i <= degree; ++i)
      for (int k = 0; k <= degree; ++k)
        all[size_t(i)][size_t(k)] = std::cos(std::numbers::pi * i * k / degree);
    return all;
  }();
  return table;
}

}  // namespace

const std::array<double, ChebyshevSeries::points>& ChebyshevSeries::sample_points() {
  return cosines()[1];
}

ChebyshevSeries::ChebyshevSeries(const std::array<double, points>& values) {
  for (size_t k = 0; k <= degree; ++k) {
    double sum = 0.5 * (values[0] + (k % 2 == 0 ? 1 : -1) * values[degree]);
    for (size_t i = 1; i < degree; ++i) sum += values[i] * cosines()[k][i];
    c_[k] = sum * (k == 0 || k == degree ? 1.0 : 2.0) / degree;
  }
}

bool ChebyshevSeries::ends(double tolerance) const {
  return std::fabs(c_[degree]) + std::fabs(c_[degree - 1]) + std::fabs(c_[degree - 2]) <= tolerance;
}

// No Chebyshev polynomial is above 1, and no derivative of the k-th polynomial is above k².
double ChebyshevSeries::clearance() const {
  double rest = 0;
  for (size_t k = 1; k <= degree; ++k) rest += std::fabs(c_[k]);
  return std::fabs(c_[0]) - rest;
}

bool ChebyshevSeries::monotone() const {
  double rest = 0;
  for (size_t k = 2; k <= degree; ++k) rest += double(k * k) * std::fabs(c_[k]);
  return std::fabs(c_[1]) > rest;
}

}  // namespace eyeray::engine::shapes
