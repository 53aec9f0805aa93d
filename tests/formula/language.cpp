// Tests of the language of formulas, and of the errors for any other text.
#include "host/formula/formula.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

namespace {

// The formula's faults as "line:column: message", a line each, its text beginning at 10:1; "" if there are
// none.
std::string faults_of(const std::string& text, std::vector<formula::FormulaParameter> parameters = {}) {
  std::string faults;
  try {
    const formula::Formula formula({text, {"a.toml", 10, 1}}, std::move(parameters), "it");
  } catch (const InputError& error) {
    for (const Diagnostic& fault : error.diagnostics())
      faults += fmt::format("{}:{}: {}\n", fault.position.line, fault.position.column, fault.message);
  }
  return faults;
}

}  // namespace

TEST_CASE("text that is no formula is refused at the fault's position") {
  CHECK(faults_of("float f(vec3 p) { return p.x; }") == "");
  CHECK(faults_of("float g(vec3 p) { return p.x; }") ==
        "10:1: the text must have a function `float f(vec3 p)`\n");
  CHECK(faults_of("float f(vec3 p) {\n  return sine(p.x);\n}") ==
        "11:10: there is no function 'sine' here; did you mean 'sin'?\n");
  CHECK(faults_of("#define X 1\nfloat f(vec3 p) { return X; }") ==
        "10:1: a formula has no preprocessor: write a const or a function\n");
  CHECK(faults_of("float f(vec3 p) { return p.x; ") == "10:17: this '{' is never closed\n");
  CHECK(faults_of("float f(vec3 p) { return p.x); }") == "10:29: this ')' has no opening bracket\n");
  CHECK(faults_of("float f(vec3 p) { mat3 m; return p.x; }") ==
        "10:19: 'mat3' cannot be used in a formula\n");
  CHECK(faults_of("float f(vec3 p) {\n  PROBE(x, p.x);\n  return p.x;\n}") ==
        "11:3: PROBE is for shaders: to see a value of a formula, return it\n");
  CHECK(faults_of("float f(vec3 p) { return p.foo; }") == "10:28: '.foo' is not a component of a vector\n");
  CHECK(faults_of("float f(vec3 p) { return 1.0lf * p.x; }") ==
        "10:26: '1.0lf' is not a number that a formula can have\n");
  CHECK(faults_of("float f(vec3 p) { return p.x; } \"") == "10:33: '\"' has no meaning in a formula\n");
  CHECK(faults_of("/* no end\nfloat f(vec3 p) { return p.x; }") ==
        "10:1: this comment has no end\n10:1: the text must have a function `float f(vec3 p)`\n");
}

TEST_CASE("undefined values, and values that depend on earlier calls, are refused") {
  CHECK(faults_of("float kept = 0.0;\nfloat f(vec3 p) { return p.x; }") ==
        "10:7: 'kept' must be const: outside of functions a formula has no variables\n");
  CHECK(faults_of("float f(vec3 p) { float a[100000]; return a[0]; }") ==
        "10:25: the size of an array must be a decimal number from 1 to 1024, written out\n");
  CHECK(faults_of("float f(vec3 p) { do { p.x += 1.0; } while (p.x < 1.0); return p.x; }") ==
        "10:19: 'do' cannot be used in a formula\n");
  CHECK(faults_of("float f(vec3 p) { return system(p); }").find("there is no function 'system' here") !=
        std::string::npos);
  CHECK(faults_of(std::string(70000, ' ')) == "10:1: a formula can have at most 65536 bytes\n");
}

TEST_CASE("a kernel has operations on numbers, private names, and nothing to fold") {
  const formula::Formula formula(
      {"const float PI = 3.5;\nfloat f(vec3 p) { return sin(PI * p.x) * 0.5 - r; }", {}}, {{"r", {0.25}}},
      "it");
  CHECK(formula.kernel("k_") ==
        "void k_0(float r0, float r1, float r2, out float r3) {\n"
        "  float r4;\n  float r5;\n  float r6;\n  float r7;\n"
        "  r4 = uintBitsToFloat(0x40600000u) * r0;\n"
        "  r5 = fn_sin(r4);\n"
        "  r6 = r5 * uintBitsToFloat(0x3f000000u);\n"
        "  r7 = r6 - uintBitsToFloat(0x3e800000u);\n"
        "  r3 = r7;\n  return;\n}\n"
        "float k_f(vec3 p) {\n  float v0;\n  k_0(p.x, p.y, p.z, v0);\n  return float(v0);\n}\n");
  CHECK_FALSE(formula.loops());
}

TEST_CASE("loops are counted, except loops with few iterations, which are unrolled") {
  const auto counted = [](const std::string& loop) {
    const formula::Formula formula(
        {"float g(float x) { return x; }\nvoid h(inout int i) { i = 0; }\nfloat f(vec3 p) { " + loop +
             " return p.x; }",
         {}},
        {}, "it");
    CHECK((formula.kernel("k_").find("formula_iterates(") != std::string::npos) == formula.loops());
    return formula.loops();
  };
  CHECK_FALSE(counted("for (int i = 0; i < 8; i++) p.x += 1.0;"));
  CHECK_FALSE(counted("for (int i = 1; i <= 64; ++i) for (int k = 0; k < 64; k++) { p.x += 1.0; }"));
  CHECK_FALSE(counted("for (int i = 0; i < 8; i++) p.x += g(1.0);"));
  CHECK(counted("for (int i = 0; i < 650; i++) for (int k = 0; k < 64; k++) p.x += 1.0;"));
  // Any write to the counter is detected, since the SPIR-V is examined.
  for (const std::string store : {"i = 0;", "i &= 0;", "i |= 1;", "i ^= 1;", "i %= 2;", "i <<= 0;", "i--;",
                                  "(i) = 0;", "h(i);", "if (p.x > 0.0) --i;"})
    CHECK(counted("for (int i = 0; i < 8; i++) { " + store + " }"));
  CHECK(counted("for (int i = 0; i < 8; ) p.x += 1.0;"));
  CHECK(counted("for (int i = 0; i < 2147483647; i += 2000000000) p.x += 1.0;"));
  CHECK(counted("int n = int(p.x); for (int i = 0; i < n; i++) p.x += 1.0;"));
  CHECK(counted("for (;;) p.x += 1.0;"));
  CHECK(counted("while (p.x < 1.0) p.x += 1.0;"));
}

TEST_CASE("a parameter that no float32 holds is refused") {
  CHECK(faults_of("float f(vec3 p) { return p.x - r; }", {{"r", {1e300}}}) ==
        "10:1: the parameter `r` = 1e+300 is beyond float32\n");
  CHECK(faults_of("float f(vec3 p) { return p.x - r; }", {{"r", {3e38}}}) == "");
}

TEST_CASE("the compiler's messages refer to the text, with its own names") {
  CHECK(faults_of("float f(vec3 p) {\n  return missing + sin(p.x);\n}") ==
        "11:10: 'missing': undeclared identifier\n");
}
