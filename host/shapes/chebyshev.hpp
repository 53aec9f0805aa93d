// A function on a segment as a Chebyshev series, which gives its values between sampled points.
#pragma once

#include <array>

namespace eyeray::engine::shapes {

class ChebyshevSeries {
 public:
  static constexpr int degree = 16;
  static constexpr int points = degree + 1;

  // The points in [−1, 1], from 1 down to −1, at which the function is sampled.
  static const std::array<double, points>& sample_points();

  explicit ChebyshevSeries(const std::array<double, points>& values);

  // True if the series has converged: judged by its last terms, the terms left out sum to less than
  // `tolerance`.
  bool ends(double tolerance) const;
  // A lower bound on the distance of the series from zero; negative if it may reach zero.
  double clearance() const;
  bool monotone() const;

 private:
  std::array<double, points> c_;
};

}  // namespace eyeray::engine::shapes
