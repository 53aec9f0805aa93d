#include "host/generate/portable_math.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/doctest.hpp"

using namespace eyeray;
using namespace eyeray::generate;

TEST_CASE("the circle is the libm's, and exact at its quarters") {
  double worst = 0;
  for (int i = -4000; i <= 4000; ++i) {
    const double degrees = i * 0.09;
    const long double angle = static_cast<long double>(degrees) * std::numbers::pi_v<long double> / 180;
    const Vec2 p = unit_circle(degrees);
    worst =
        std::max({worst, std::abs(p.x - double(std::cos(angle))), std::abs(p.y - double(std::sin(angle)))});
  }
  CHECK(worst < 3e-16);
  CHECK(unit_circle(0) == Vec2(1, 0));
  CHECK(unit_circle(90) == Vec2(0, 1));
  CHECK(unit_circle(-180) == Vec2(-1, 0));
  CHECK(unit_circle(270) == Vec2(0, -1));
  CHECK(unit_circle(-90) == Vec2(0, -1));
}

TEST_CASE("the logarithm is the libm's") {
  double worst = 0;
  for (double x = 1e-300; x < 1e300; x *= 1.37) {
    const double expected = std::log(x);
    worst = std::max(worst, std::abs(natural_log(x) - expected) / std::abs(expected));
  }
  for (double x = 0.4; x < 2.1; x += 0.00037) {
    const double expected = std::log(x);
    worst = std::max(worst, std::abs(natural_log(x) - expected) / std::abs(expected));
  }
  CHECK(worst < 5e-16);
  CHECK(natural_log(1) == 0);
}
