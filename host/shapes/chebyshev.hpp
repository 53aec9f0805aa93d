// A function on a segment as a Chebyshev series: what it comes to between places that were looked at.
#pragma once

#include <array>

namespace eyeray::engine::shapes {

class ChebyshevSeries {
 public:
  static constexpr int degree = 16;
  static constexpr int points = degree + 1;

  // The places in [−1, 1], from 1 down to −1, at which values are wanted.
  static const std::array<double, points>& places();

  explicit ChebyshevSeries(const std::array<double, points>& values);

  // Whether the series has come to its end: what is left out is less than `tolerance`, as far as its last
  // terms tell.
  bool ends(double tolerance) const;
  // How far from zero it stays; negative where it may not.
  double ray_offset() const;
  bool monotone() const;

 private:
  std::array<double, points> c_;
};

}  // namespace eyeray::engine::shapes
