// The functions of math/formula.glsl that formulas call, against float64.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "host/twin/shader_functions.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using test::Random;

namespace {

struct Function {
  std::string name;
  std::function<float(float)> ours;
  std::function<double(double)> exact;
  double low, high;
  double most = 2.5e-7;  // the error, absolute or relative, whichever is less
};

#define AS_IN_C(name, ...) \
  {#name, [](float x) { return shader::fn_##name(x); }, [](double x) { return std::name(x); }, __VA_ARGS__}

const std::vector<Function> functions{
    AS_IN_C(sin, -100, 100),
    AS_IN_C(cos, -100, 100),
    AS_IN_C(asin, -1, 1),
    AS_IN_C(acos, -1, 1),
    AS_IN_C(atan, -50, 50),
    AS_IN_C(exp, -20, 20),
    AS_IN_C(log, 1e-6, 1e6),
    AS_IN_C(exp2, -20, 20, 1e-6),
    AS_IN_C(log2, 1e-6, 1e6),
    AS_IN_C(sinh, -8, 8),
    AS_IN_C(cosh, -8, 8),
    AS_IN_C(tanh, -8, 8),
    AS_IN_C(sqrt, 0, 1e6),
    {"sinh near 0", [](float x) { return shader::fn_sinh(x); }, [](double x) { return std::sinh(x); }, -0.6,
     0.6},
};

}  // namespace

TEST_CASE("functions of formulas are as accurate as their file states") {
  const int trials = test::amount(20'000, 200'000, 2'000'000);
  for (const Function& function : functions) {
    Random random(5);
    double worst = 0;
    for (int i = 0; i < trials; ++i) {
      const auto x = float(random.uniform(function.low, function.high));
      const double exact = function.exact(double(x));
      const double error = std::fabs(double(function.ours(x)) - exact) / std::max(1.0, std::fabs(exact));
      worst = std::isnan(error) ? HUGE_VAL : std::max(worst, error);
    }
    CAPTURE(function.name);
    MESSAGE(fmt::format("{}: worst error {:.2e}", function.name, worst));
    CHECK(worst <= function.most);
  }
}
