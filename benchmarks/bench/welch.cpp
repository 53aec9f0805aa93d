#include "benchmarks/bench/welch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace eyeray::engine::bench {
namespace {

// The continued fraction of the incomplete beta function, by Lentz' method (DLMF 8.17.22).
double beta_fraction(double a, double b, double x) {
  constexpr double tiny = 1e-300;
  const auto away_from_0 = [](double value) { return std::abs(value) < tiny ? tiny : value; };
  double c = 1, d = 1 / away_from_0(1 - (a + b) * x / (a + 1)), value = d;
  for (int m = 1; m < 300; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    double step = 1;
    for (const double term : {even, odd}) {
      d = 1 / away_from_0(1 + term * d);
      c = away_from_0(1 + term / c);
      step = c * d;
      value *= step;
    }
    if (std::abs(step - 1) < 1e-15) break;
  }
  return value;
}

// I_x(a, b), regularised.
double incomplete_beta(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
  return x < (a + 1) / (a + b + 2) ? front * beta_fraction(a, b, x) / a
                                   : 1 - front * beta_fraction(b, a, 1 - x) / b;
}

}  // namespace

Moments moments(std::span<const double> runs) {
  Moments result;
  result.count = int(runs.size());
  for (const double run : runs) result.mean += run / result.count;
  for (const double run : runs)
    result.variance += (run - result.mean) * (run - result.mean) / std::max(1, result.count - 1);
  return result;
}

double student_tails(double t, double freedom) {
  return incomplete_beta(freedom / 2, 0.5, freedom / (freedom + t * t));
}

WelchTest welch(const Moments& a, const Moments& b) {
  const double va = a.variance / a.count, vb = b.variance / b.count;
  const double difference = std::abs(a.mean - b.mean);
  if (!(va + vb > 0)) {
    const bool same = difference <= 1e-6 * std::abs(a.mean);  // equal to within float32's rounding
    return {same ? 0 : std::numeric_limits<double>::infinity(), 1, same ? 1.0 : 0.0};
  }
  WelchTest test;
  test.t = difference / std::sqrt(va + vb);
  test.freedom = (va + vb) * (va + vb) / (va * va / (a.count - 1) + vb * vb / (b.count - 1));
  test.p = student_tails(test.t, test.freedom);
  return test;
}

}  // namespace eyeray::engine::bench
