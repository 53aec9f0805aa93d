// Tests whether two renderers agree on average, by several runs of each with different seeds.
#pragma once

#include <span>

namespace eyeray::engine::bench {

struct Moments {
  double mean = 0;
  double variance = 0;  // variance of a run, unbiased
  int count = 0;
};
Moments moments(std::span<const double> runs);

// Welch's test of the hypothesis that two means are equal: Welch, "The Generalization of 'Student's' Problem
// when Several Different Population Variances are Involved" (Biometrika 1947).
struct WelchTest {
  double t = 0;
  double freedom = 0;  // degrees of freedom
  double p = 1;        // probability of |t| or more; 1 if neither varies and both are equal
};
WelchTest welch(const Moments& a, const Moments& b);

// The probability of |t| or more with `freedom` degrees of freedom: Student's distribution, both sides.
double student_tails(double t, double freedom);

}  // namespace eyeray::engine::bench
