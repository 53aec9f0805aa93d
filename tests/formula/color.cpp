// Formulas of colours: their required functions, and their results.
#include "host/formula/formula.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

namespace {

formula::Formula color(const std::string& text, std::vector<formula::FormulaParameter> parameters = {}) {
  return {{text, {"a.toml", 10, 1}}, std::move(parameters), "it", formula::FormulaKind::color};
}

std::string fault_of(const std::string& text, std::vector<formula::FormulaParameter> parameters = {}) {
  try {
    (void)color(text, std::move(parameters));
  } catch (const InputError& error) {
    const Diagnostic& fault = error.diagnostics().at(0);
    return fmt::format("{}:{}: {}", fault.position.line, fault.position.column, fault.message);
  }
  return "";
}

}  // namespace

TEST_CASE("a colour is a function of uv") {
  CHECK(fault_of("vec3 color(vec2 uv) { return vec3(uv, 0.0); }") == "");
  const std::string missing = "10:1: the text must have a function `vec3 color(vec2 uv)`";
  CHECK(fault_of("float f(vec3 p) { return p.x; }") == missing);
  CHECK(fault_of("vec3 color(vec3 p) { return p; }") == missing);
  CHECK(fault_of("vec3 color(vec2 uv);") == missing);
  CHECK(fault_of("vec3 color(vec2 uv) {\n  return vec3(missing);\n}") ==
        "11:15: 'missing': undeclared identifier");
  CHECK(fault_of("vec3 color(vec2 uv) { return vec3(0.0); }", {{"color", {1}}}) ==
        "10:1: no parameter can be named `color`: that is the function's name");
}

TEST_CASE("a colour has exact bits in float32, and a float64 value") {
  // Parameters, arrays, a uv that is written to, a function that has the name of a surface's.
  const formula::Formula formula = color(
      "vec3 gradient(vec3 p) { return p * p; }\n"
      "vec3 color(vec2 uv) {\n"
      "  float a[2] = float[2](scale, 2.0);\n"
      "  uv.x += 1.0;\n"
      "  return gradient(vec3(uv * a[int(uv.y)], 1.0 / 3.0));\n"
      "}\n",
      {{"scale", {0.1}}});
  CHECK_FALSE(formula.has_other());
  const std::array<float, 3> single = formula.color(std::array{2.0f, 0.5f});
  const float x = 3.0f * 0.1f, y = 0.5f * 0.1f, z = 1.0f / 3.0f;
  CHECK(single == std::array{x * x, y * y, z * z});
  const std::array<double, 3> both = formula.color(std::array{1.0, 1.5});
  CHECK(both[0] == 16);
  CHECK(both[1] == 9);
  CHECK(both[2] == doctest::Approx(1.0 / 9).epsilon(1e-7));  // a literal in the text is float32
}

TEST_CASE("the same text as another kind is a different formula") {
  const std::string text = "float f(vec3 p) { return p.x; }\nvec3 color(vec2 uv) { return vec3(uv, 1.0); }\n";
  const formula::Formula surface({text, {}}, {}, "it");
  const formula::Formula colored = color(text);
  CHECK_FALSE(surface.same(colored));
  CHECK(colored.same(color(text)));
  CHECK(surface.value(std::array{0.25f, 0.0f, 0.0f}) == 0.25f);
  CHECK(colored.color(std::array{0.25f, 0.5f}) == std::array{0.25f, 0.5f, 1.0f});
  CHECK(colored.kernel("k_").find("vec3 k_color(vec2 p) {") != std::string::npos);
}

TEST_CASE("a colour whose loop does not end is a time-out") {
  const formula::Formula formula =
      color("vec3 color(vec2 uv) { while (uv.x > 0.5) uv.y += 1.0; return vec3(uv.y); }");
  CHECK(formula.loops());
  CHECK(formula.color(std::array{0.25f, 0.75f})[0] == 0.75f);
  CHECK_THROWS_AS((void)formula.color(std::array{0.75f, 0.75f}), Error);
}
