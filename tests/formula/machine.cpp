// Formulas run on the CPU, in float32 and in float64.
#include <cmath>
#include <random>

#include "host/formula/formula.hpp"
#include "host/shapes/ready_formulas.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;

namespace {

double value_of(const std::string& expression, const std::string& before = "") {
  const formula::Formula formula({before + "float f(vec3 p) { " + expression + " }", {}},
                                 {{"r", {0.25}}, {"v", {1, 2, 3}}}, "the formula");
  const double exact = formula.value(std::array{0.5, -2.0, 3.0});
  CHECK(double(formula.value(std::array{0.5f, -2.0f, 3.0f})) == doctest::Approx(exact).epsilon(1e-6));
  return exact;
}

double length(const std::array<double, 3>& v) {
  return std::hypot(v[0], v[1], v[2]);
}

}  // namespace

TEST_CASE("formulas are computed as GLSL defines") {
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
  // The names of other languages mean nothing.
  CHECK(value_of("float class = 2.0; float this = class; return this;") == doctest::Approx(2));
}

TEST_CASE("divisions by 0, indices outside arrays and functions without a final return are defined") {
  CHECK(value_of("int zero = int(p.x); return float(7 / zero) + float(7 % zero);") == 0);
  CHECK(value_of("float a[2] = float[2](1.0, 2.0); return a[int(p.z) * 1000];") == 2);
  CHECK(value_of("int i = 2147483647; i++; return float(i);") == -2147483648.0);
  CHECK(value_of("return g(p.x);", "float g(float x) { if (x > 1.0) return 1.0; }\n") == 0);
}

TEST_CASE("arrays are values") {
  const std::string four = "float a[4]; for (int i = 0; i < 4; i++) a[i] = float(i); ";
  CHECK(value_of(four + "float s = g(a); return a[0] * 10.0 + s;",
                 "float g(float a[4]) { a[0] = 9.0; return a[1]; }\n") == 1);
  CHECK(value_of(four + "float b[4] = a; b[1] = 5.0; return a[1] + float(a == b) * 10.0;") == 1);
  CHECK(value_of(four + "float b[4] = a; return float(a == b) + float(a != b) * 10.0;") == 1);
  CHECK(value_of(four + "h(a, a[3]); return a[1] + a[3] * 10.0;",
                 "void h(inout float a[4], out float x) { a[1] = 6.0; x = 2.0; }\n") == 26);
  CHECK(value_of(four + "float b[4]; for (int i = 0; i < 4; i++) b[i] = 8.0; return (p.x > 0.0 ? a : "
                        "b)[int(p.z)] + (a)[2];") == 5);
  CHECK(value_of("vec3 q = p; q.xy[0] = 4.0; q.zy[int(p.x)] = 5.0; return q.x * 100.0 + q.y * 10.0 + q.z;") ==
        doctest::Approx(385));
  CHECK(
      value_of(
          "vec2 a[3]; a[int(p.z) - 1].y = 3.0; a[0][int(p.x) + 1] += 2.0; return a[2].y * 10.0 + a[0].y;") ==
      32);
  CHECK(value_of("const float t[5] = float[](1.0, 2.0, 4.0, 8.0, 16.0); float s = 0.0; for (int i = 4; i >= "
                 "0; i -= 2) s += t[i]; return s;") == 21);
}

TEST_CASE("whole numbers wrap around, shifts are masked, indices are clamped") {
  CHECK(value_of("int x = int(p.z); x <<= 2; x >>= 1; return float(x);") == 6);
  CHECK(value_of("int x = 1; int s = int(p.z) * 11; return float(x << s) + float(8 >> (s - 1));") == 2 + 8);
  CHECK(value_of("int x = -7; int y = int(p.z); return float(x / y) * 100.0 + float(x % y);") == -198);
  CHECK(value_of("int least = -2147483647 - int(p.x + 1.0); int m = int(-p.z) / 3; return float(least / m) + "
                 "float(least % m);") == -2147483648.0);
  CHECK(value_of("uint x = uint(p.x); x -= 1u; return float(x >> 31u) + float(x % 10u);") == 6);
  CHECK(value_of("return float(int(p.x * 1e20)) + float(uint(-p.z)) + float(int(sqrt(p.y)));") ==
        -2 * 2147483648.0);
  CHECK(
      value_of("float a[3] = float[3](5.0, 6.0, 7.0); return a[int(p.y) * 1000] * 10.0 + a[int(p.z) + 7];") ==
      57);
  CHECK(value_of("return p[int(p.z) + 5] * 10.0 + p[int(p.y)];") == doctest::Approx(30.5));
  // A variable read before it is written is 0, in every call.
  CHECK(value_of("float s = 0.0; for (int i = 0; i < 3; i++) s += g(p.x, i); return s;",
                 "float g(float x, int i) { float t; if (i == 0) t = 5.0; return t; }\n") == 5);
}

TEST_CASE("loops and functions follow every control flow") {
  CHECK(value_of("float s = 0.0; for (int i = 0; i < 9; i++) { if (i == 2) continue; if (i == 5) break; s += "
                 "float(i); } return s;") == 8);
  CHECK(value_of("float s = 0.0; int i = 0; while (true) { i++; if (i % 2 == 0) continue; s += float(i); if "
                 "(i > 6) return s; } return 0.0;") == 16);
  CHECK(value_of("return g(1.0) + g(5.0) * 10.0;",
                 "float g(float x) { for (int i = 0; i < 4; i++) for (int k = 0; k < 4; k++) if (float(i * "
                 "k) > x) return float(i) + 0.5 * float(k); return -1.0; }\n") == 37);
  CHECK(value_of("bool b = p.x > 0.0 && (p.y > 0.0 || p.z > 0.0); bool c = !b ^^ true; return float(b) + "
                 "float(c) * 2.0;") == 3);
  CHECK(value_of("p = p.yzx; p.xy = p.yx; float t = p.x; p.x = p.y; p.y = t; return p.x * 100.0 + p.y * 10.0 "
                 "+ p.z;") == doctest::Approx(-200 + 30 + 0.5));
  CHECK(value_of("float a = p.x, b = p.y; swap(a, b); return a * 10.0 + b;",
                 "void swap(inout float a, inout float b) { float c = a; a = b; b = c; }\n") ==
        doctest::Approx(-19.5));
  CHECK(value_of("float x = 1.0; float y = x++ + ++x; return y * 10.0 + x;") == 43);
  CHECK(value_of("float x = p.x; float y = x; x = 7.0; return y;") == 0.5);
}

TEST_CASE("a loop that does not end is an error, and the program goes on") {
  const formula::Formula endless({"float f(vec3 p) { for (;;) p.x += 1.0; return p.x; }", {}}, {},
                                 "the formula");
  for (int i = 0; i < 2; ++i) {
    try {
      (void)endless.value(std::array{0.0, 0.0, 0.0});
      FAIL("it came to an end");
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::timed_out);
      CHECK(std::string(error.what()).starts_with("the formula did not end"));
    }
  }
}

TEST_CASE("built-in formulas are no steeper than their Lipschitz bounds, and their gradients are right") {
  for (const ReadyFormula& ready : ready_formulas()) {
    if (!ready.lipschitz) continue;
    CAPTURE(ready.name);
    const formula::Formula formula({std::string(ready.text), {}}, ready.parameters, "it");
    CHECK(formula.has_other());
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
