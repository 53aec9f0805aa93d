// Formulas as C++, in float32 and in float64.
#include <cmath>
#include <random>

#include "formula/formula.hpp"
#include "shapes/ready_formulas.hpp"

#include "support/doctest.hpp"

using namespace eyeray;

namespace {

double value_of(const std::string& expression, const std::string& before = "") {
  const Formula formula({before + "float f(vec3 p) { " + expression + " }", {}},
                        {{"r", {0.25}}, {"v", {1, 2, 3}}}, "the formula");
  formula.compile();
  const double exact = formula.value(std::array{0.5, -2.0, 3.0});
  CHECK(double(formula.value(std::array{0.5f, -2.0f, 3.0f})) == doctest::Approx(exact).epsilon(1e-6));
  return exact;
}

double length(const std::array<double, 3>& v) {
  return std::hypot(v[0], v[1], v[2]);
}

}  // namespace

TEST_CASE("what GLSL says, C++ computes") {
  CHECK(value_of("return p.x + p.y * p.z - r;") == doctest::Approx(0.5 - 6 - 0.25));
  CHECK(value_of("return dot(p, v.zyx);") == doctest::Approx(1.5 - 4 + 3));
  CHECK(value_of("p.xz = p.zx * 2.0; return p.x * 10.0 + p.z;") == doctest::Approx(61));
  CHECK(value_of("p.yz *= 3.0; return p.y + p.z;") == doctest::Approx(3));
  CHECK(value_of("turn(p.xy); return p.x;", "void turn(inout vec2 w) { w = vec2(w.y, -w.x); }\n") ==
        doctest::Approx(-2));
  CHECK(value_of("float a[3] = float[3](1.0, 2.0, 4.0); float s = 0.0; for (int i = 0; i < 3; i++) s += "
                 "a[i]; return s;") == doctest::Approx(7));
  CHECK(value_of("return float(7 / 2) + float(7 % 4) * 0.1;") == doctest::Approx(3.3));
  CHECK(value_of("return pow(p.z, 2) + max(p.x, 1);") == doctest::Approx(10));
  CHECK(value_of("uint h = uint(3) * 2654435769u; return float(h >> 24u);") == doctest::Approx(218));
  CHECK(value_of("return p.x < 0.0 ? 1.0 : length(vec2(3.0, 4.0));") == doctest::Approx(5));
  CHECK(value_of("return mix(vec3(1.0), p, 0.5).z + smoothstep(0.0, 1.0, p.x) + mod(-0.25, 1.0);") ==
        doctest::Approx(2 + 0.5 + 0.75));
  // The names of C++ mean nothing.
  CHECK(value_of("float class = 2.0; float this = class; return this;") == doctest::Approx(2));
}

TEST_CASE("nothing is undefined: divisions by 0, places outside of arrays, functions without an end") {
  CHECK(value_of("int zero = int(p.x); return float(7 / zero) + float(7 % zero);") == 0);
  CHECK(value_of("float a[2] = float[2](1.0, 2.0); return a[int(p.z) * 1000];") == 2);
  CHECK(value_of("int i = 2147483647; i++; return float(i);") == -2147483648.0);
  CHECK(value_of("return g(p.x);", "float g(float x) { if (x > 1.0) return 1.0; }\n") == 0);
}

TEST_CASE("a loop that does not end is an error, and the program goes on") {
  const Formula endless({"float f(vec3 p) { for (;;) p.x += 1.0; return p.x; }", {}}, {}, "the formula");
  for (int i = 0; i < 2; ++i) {
    try {
      (void)endless.value(std::array{0.0, 0.0, 0.0});
      FAIL("it came to an end");
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::timed_out);
      CHECK(std::string(error.what()).starts_with("the formula did not come to an end"));
    }
  }
}

TEST_CASE("the formulas that come with eyeray are as steep as they say, and their gradients are right") {
  for (const ReadyFormula& ready : ready_formulas()) {
    if (!ready.lipschitz) continue;
    CAPTURE(ready.name);
    const Formula formula({std::string(ready.text), {}}, ready.parameters, "it");
    CHECK(formula.has_gradient());
    const double bound = ready.lipschitz(ready.parameters);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> uniform(-1.2, 1.2);
    double steepest = 0;
    int seen = 0, right = 0;
    for (int i = 0; i < 20000; ++i) {
      const std::array<double, 3> p{uniform(random), uniform(random), uniform(random)};
      std::array<double, 3> gradient;
      for (size_t axis = 0; axis < 3; ++axis) {
        constexpr double step = 1e-6;
        auto a = p, b = p;
        a[axis] += step;
        b[axis] -= step;
        gradient[axis] = (formula.value(a) - formula.value(b)) / (2 * step);
      }
      steepest = std::max(steepest, length(gradient));
      if (std::fabs(formula.value(p)) > 0.01) continue;
      const auto own = formula.gradient(std::array{float(p[0]), float(p[1]), float(p[2])});
      double dot = 0;
      for (size_t axis = 0; axis < 3; ++axis) dot += double(own[axis]) * gradient[axis];
      const double cosine =
          dot / (length(gradient) * length({double(own[0]), double(own[1]), double(own[2])}));
      ++seen;
      right += cosine > 0.99999;
    }
    CHECK(steepest <= bound * 1.0001);
    CHECK(seen > 20);
    CHECK(right >= 0.99 * seen);
  }
}
