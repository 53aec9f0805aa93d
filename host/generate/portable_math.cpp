#include "host/generate/portable_math.hpp"

#include <cmath>
#include <numbers>

namespace eyeray::generate {

Vec2 unit_circle(double degrees) {
  const double quarter = std::floor(degrees / 90 + 0.5);
  const double x = (degrees - 90 * quarter) * (std::numbers::pi / 180);  // from −π/4 to π/4

  // Taylor's series as far as float64 goes, the last terms first.
  double cosine = 1, sine = 1;
  for (int k = 16; k >= 2; k -= 2) {
    cosine = 1 - x * x / (k * (k - 1)) * cosine;
    sine = 1 - x * x / (k * (k + 1)) * sine;
  }
  sine *= x;

  const Vec2 turned[4] = {{cosine, sine}, {-sine, cosine}, {-cosine, -sine}, {sine, -cosine}};
  return turned[int(quarter) & 3];
}

double natural_log(double x) {
  int exponent = 0;
  double mantissa = std::frexp(x, &exponent);  // from ½ to 1; exact
  if (mantissa < std::numbers::sqrt2 / 2) {
    mantissa *= 2;
    --exponent;
  }
  // ln m = 2 artanh s, where |s| ≤ 0.172.
  const double s = (mantissa - 1) / (mantissa + 1);
  double sum = 0;
  for (int k = 21; k >= 3; k -= 2) sum = s * s * (sum + 1.0 / k);
  return exponent * std::numbers::ln2 + 2 * (s + s * sum);
}

}  // namespace eyeray::generate
