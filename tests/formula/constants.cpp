// A constant expression has the same value as a computed one, and variables begin with 0 each time.
// EYERAY_FULL_TESTS=1 draws a million texts, EYERAY_SEED other ones.
#include <cstring>

#include "host/formula/formula.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/known_formula.hpp"
//
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

namespace {

float result_of(const std::string& body, const std::string& before = "") {
  const formula::Formula formula({before + "float f(vec3 p) { " + body + " }", {}}, {{"tenth", {0.1}}}, "it");
  return formula.value(std::array{0.5f, 2.0f, 0.0f});
}

}  // namespace

TEST_CASE("random formulas of constants and computed values give the results of the rules") {
  const int count = test::amount(2'000, 30'000, 1'000'000);
  for (int i = 0; i < count; ++i) {
    const test::KnownFormula known(test::seed() * 10'000'000 + uint64_t(i));
    CAPTURE(known.text());
    const formula::Formula formula({known.text(), {"f.glsl", 1, 1}}, {}, "it");
    const float upper = formula.value(std::array{1.0f, 0.0f, 0.0f});
    const float lower = formula.value(std::array{-1.0f, 0.0f, 0.0f});
    if (known.is_float()) {
      float expected;
      const uint32_t bits = known.expected();
      std::memcpy(&expected, &bits, sizeof expected);
      REQUIRE(lower == expected);
    } else {
      REQUIRE(upper == float(known.expected() >> 16));
      REQUIRE(lower == float(known.expected() & 0xffffu));
    }
  }
}

TEST_CASE("whole numbers of constants follow the rules of all whole numbers") {
  const std::string zero = "int zero = int(p.z); ";
  CHECK(result_of("return float(7 / 0) + float(7 % 0);") == 0);
  CHECK(result_of(zero + "return float(7 / 0 == 7 / zero) + float(7u % 0u == 7u % uint(zero));") == 2);
  CHECK(result_of("return float(-7 % 3) * 10.0 + float(7 % -3);") == 18);
  CHECK(result_of("return float(1 << 33) + float(8 >> 34);") == 4);
  CHECK(result_of("return float(least / -1) + float(least % -1);", "const int least = -2147483647 - 1;\n") ==
        -2147483648.0f);
  CHECK(result_of("return float(int(1e20)) + float(uint(-3.0));") == -2147483648.0f);
}

TEST_CASE("bounds follow the rules of whole numbers too") {
  for (const std::string step : {"k += 7 / i;", "k += 7 % i;", "u = u * u; k += int(u / uint(i));"}) {
    CAPTURE(step);
    const formula::Formula formula(
        {"float f(vec3 p) { int k = 0; uint u = 4278190081u; for (int i = 0; i < 3; "
         "i++) { " +
             step + " } return p.x + float(k); }",
         {}},
        {}, "it");
    CHECK(formula.straight_line().size() > 0);
  }
}

TEST_CASE("constants are computed in float32, one operation after the other") {
  const float third = 1.0f / 3.0f, tenth = 0.1f;
  CHECK(result_of("return 1.0 / 3.0 * 3.0 - 1.0;") == third * 3.0f - 1.0f);
  CHECK(result_of("return 16777216.0 + 1.0 + 1.0 - 16777216.0;") == 0);
  CHECK(result_of("return k * k * tenth;", "const float k = 0.1 * 0.1;\n") ==
        tenth * tenth * (tenth * tenth) * tenth);
  CHECK(result_of(
            "return t[int(p.y)].y;",
            "const float a = 0.1;\nconst vec2 t[3] = vec2[3](vec2(a), vec2(a * a), vec2(a, a * 0.7));\n") ==
        tenth * 0.7f);
}

TEST_CASE("constants of every shape can be selected, shadowed, and read at constant and computed indices") {
  const std::string table =
      "const bool odd = 3 % 2 == 1;\nconst int n = odd ? 2 : 5;\nconst float t[4] = float[4](1.0, 2.0 * 2.0, "
      "float(n), -8.0), u = 0.5;\nconst vec3 v = vec3(u, t[1], t[n]);\n";
  CHECK(result_of("return v.x + v.y * 10.0 + v.z * 100.0;", table) == 240.5f);
  CHECK(result_of("return t[int(p.y)] + t[int(p.y) * 1000] + v[int(p.y)];", table) == 2 - 8 + 2);
  CHECK(result_of("float u = 7.0; { const int n = 3; u += float(n); } return u + float(n);", table) == 12);
  CHECK(result_of("return g(t) + t[0];",
                  table + "float g(float t[4]) { t[0] = 9.0; return t[0] + t[1]; }\n") == 14);
  CHECK(result_of(
            "float s = 0.0; for (int i = 0; i < n * n; i++) { const int k = n + 1; for (int j = 0; j < k; "
            "j++) s += 1.0; } return s;",
            table) == 12);
}

TEST_CASE("a variable begins with 0 wherever it is declared, each time") {
  const auto seen = [](const std::string& declared, const std::string& read, const std::string& written) {
    return result_of("float seen = 0.0; for (int i = 0; i < 3; i++) { " + declared + " seen += " + read +
                     "; " + written + " } return seen;");
  };
  CHECK(seen("float a;", "a", "a = 0.75;") == 0);
  CHECK(seen("float b = 1.0, a;", "a", "a = 0.75;") == 0);
  CHECK(seen("vec3 a;", "a.z + a.x", "a = p; a.z = 5.0;") == 0);
  CHECK(seen("bool a;", "float(a)", "a = true;") == 0);
  CHECK(seen("uint a, b[2], c;", "float(a + b[1] + c)", "a++; b[i] = 3u; b[1] = 2u; c = 9u;") == 0);
  CHECK(seen("vec2 a[3];", "a[i].y + a[2].x", "a[int(p.y)].x = 4.0; a[i] = p.xy;") == 0);
  CHECK(seen("{ float a; if (p.x > 0.0) {", "a", "a = 2.0; } }") == 0);
  // A variable declared in a loop's head lives as long as the loop.
  CHECK(result_of("float s = 0.0; for (int i, k; i < 3; i++) { s += float(k); k = i; } return s;") == 1);
}

TEST_CASE("an out parameter begins with 0, each time") {
  const std::string g = "void g(out float a, inout float s) { s += a; a = 0.75; }\n";
  CHECK(result_of("float a = 3.0, s = 0.0; for (int i = 0; i < 3; i++) g(a, s); return s + a;", g) == 0.75f);
  CHECK(result_of("float a[2] = float[2](1.0, 2.0); h(a, p.xy); return a[0] + a[1] * 10.0 + p.x;",
                  "void h(out float a[2], out vec2 v) { v.y += a[1]; a[0] += 4.0; }\n") == 4);
}
