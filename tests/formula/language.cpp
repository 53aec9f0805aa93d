// What a formula may say, and what is said of one that says anything else.
#include "formula/formula.hpp"

#include "support/doctest.hpp"

using namespace eyeray;

namespace {

// The formula's faults as "line:column: message", a line each, its text beginning at 10:1; "" if there are
// none.
std::string faults_of(const std::string& text, std::vector<FormulaParameter> parameters = {}) {
  std::string said;
  try {
    const Formula formula({text, {"a.toml", 10, 1}}, std::move(parameters), "it");
  } catch (const InputError& error) {
    for (const Diagnostic& fault : error.diagnostics())
      said += fmt::format("{}:{}: {}\n", fault.position.line, fault.position.column, fault.message);
  }
  return said;
}

}  // namespace

TEST_CASE("what is no formula is refused at its place") {
  CHECK(faults_of("float f(vec3 p) { return p.x; }") == "");
  CHECK(faults_of("float g(vec3 p) { return p.x; }") ==
        "10:1: the text must have a function `float f(vec3 p)`\n");
  CHECK(faults_of("float f(vec3 p) {\n  return sine(p.x);\n}") ==
        "11:10: there is no function 'sine' here; did you mean 'sin'?\n");
  CHECK(faults_of("#define X 1\nfloat f(vec3 p) { return X; }") ==
        "10:1: a formula has no preprocessor: write a const or a function\n");
  CHECK(faults_of("float f(vec3 p) { return p.x; ") == "10:17: this '{' is never closed\n");
  CHECK(faults_of("float f(vec3 p) { return p.x); }") == "10:29: this ')' closes nothing\n");
  CHECK(faults_of("float f(vec3 p) { mat3 m; return p.x; }") ==
        "10:19: 'mat3' cannot be used in a formula\n");
  CHECK(faults_of("float f(vec3 p) { return p.foo; }") == "10:28: '.foo' is no part of a vector\n");
  CHECK(faults_of("float f(vec3 p) { return 1.0lf * p.x; }") ==
        "10:26: '1.0lf' is no number that is known here\n");
  CHECK(faults_of("float f(vec3 p) { return p.x; } \"") == "10:33: '\"' has no meaning in a formula\n");
  CHECK(faults_of("/* no end\nfloat f(vec3 p) { return p.x; }") ==
        "10:1: this comment has no end\n10:1: the text must have a function `float f(vec3 p)`\n");
}

TEST_CASE("what would be undefined, or depend on what was asked before, is refused") {
  CHECK(faults_of("float kept = 0.0;\nfloat f(vec3 p) { return p.x; }") ==
        "10:7: 'kept' must be const: outside of functions a formula has no variables\n");
  CHECK(faults_of("float f(vec3 p) { float a[100000]; return a[0]; }") ==
        "10:25: the size of an array must be a number from 1 to 1024, written out\n");
  CHECK(faults_of("float f(vec3 p) { do { p.x += 1.0; } while (p.x < 1.0); return p.x; }") ==
        "10:19: 'do' cannot be used in a formula\n");
  CHECK(faults_of("float f(vec3 p) { return system(p); }").find("there is no function 'system' here") !=
        std::string::npos);
  CHECK(faults_of(std::string(70000, ' ')) == "10:1: a formula has at most 65536 bytes\n");
}

TEST_CASE("a kernel's names are its own, and nothing of it is folded before it is rounded") {
  const Formula formula({"const float PI = 3.5;\nfloat f(vec3 p) { return sin(PI * p.x) * 0.5 - r; }", {}},
                        {{"r", {0.25}}}, "it");
  CHECK(
      formula.kernel("k_") ==
      "float k_r = float(uintBitsToFloat(0x3e800000u));\n"
      "float k_PI = uintBitsToFloat(0x40600000u) ;\n"
      "float k_f ( vec3 k_p ) { return fn_sin ( k_PI * k_p . x ) * uintBitsToFloat(0x3f000000u) - k_r ; }\n");
  CHECK_FALSE(formula.loops());
}

TEST_CASE("loops are counted, but those whose few turns are written out") {
  const auto counted = [](const std::string& loop) {
    const Formula formula(
        {"float g(float x) { return x; }\nfloat f(vec3 p) { " + loop + " return p.x; }", {}}, {}, "it");
    CHECK((formula.kernel("k_").find("formula_turn()") != std::string::npos) == formula.loops());
    return formula.loops();
  };
  CHECK_FALSE(counted("for (int i = 0; i < 8; i++) p.x += 1.0;"));
  CHECK_FALSE(counted("for (int i = 1; i <= 64; ++i) for (int k = 0; k < 64; k++) { p.x += 1.0; }"));
  CHECK(counted("for (int i = 0; i < 65; i++) for (int k = 0; k < 64; k++) p.x += 1.0;"));
  CHECK(counted("for (int i = 0; i < 8; i++) { i = 0; }"));
  CHECK(counted("for (int i = 0; i < 8; i++) p.x += g(1.0);"));
  CHECK(counted("for (;;) p.x += 1.0;"));
  CHECK(counted("while (p.x < 1.0) p.x += 1.0;"));
}

TEST_CASE("what a compiler says of the translation is said of the text, with its own names") {
  const Formula formula({"float f(vec3 p) {\n  return missing + sin(p.x);\n}", {"a.toml", 10, 5}}, {}, "it");
  Diagnostic diagnostic;
  diagnostic.position = {"text", 2, 10};
  diagnostic.message = "'user_missing': undeclared identifier, nor 'fn_sin'";
  const Diagnostic shown = formula.in_user_text(diagnostic);
  CHECK(shown.position.file == "a.toml");
  CHECK(shown.position.line == 11);
  CHECK(shown.position.column == 10);
  CHECK(shown.message == "'missing': undeclared identifier, nor 'sin'");
  CHECK(shown.source_line == "  return missing + sin(p.x);");
}
