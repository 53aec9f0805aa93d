// Formulas of cameras: their required functions, and their results.
#include "host/formula/formula.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

namespace {

formula::Formula camera(const std::string& text, std::vector<formula::FormulaParameter> parameters = {}) {
  return {{text, {"a.toml", 10, 1}}, std::move(parameters), "it", formula::FormulaKind::camera};
}

std::string fault_of_camera(const std::string& text) {
  try {
    (void)camera(text);
  } catch (const InputError& error) {
    const Diagnostic& fault = error.diagnostics().at(0);
    return fmt::format("{}:{}: {}", fault.position.line, fault.position.column, fault.message);
  }
  return "";
}

}  // namespace

TEST_CASE("a camera is a function of a point in the picture and a point on the lens") {
  CHECK(fault_of_camera("vec3 direction(vec2 place, vec2 lens) { return vec3(place, 1.0); }") == "");
  CHECK(fault_of_camera("vec3 direction(const in vec2 a, in vec2 b) { return vec3(a, 1.0); }") == "");
  const std::string missing = "10:1: the text must have a function `vec3 direction(vec2 place, vec2 lens)`";
  CHECK(fault_of_camera("vec3 direction(vec2 place) { return vec3(place, 1.0); }") == missing);
  CHECK(fault_of_camera("vec3 direction(vec4 at) { return at.xyz; }") == missing);
  CHECK(fault_of_camera("vec3 direction(vec2 place, vec3 lens) { return lens; }") == missing);
  CHECK(fault_of_camera("vec3 direction(vec2 place, vec2 lens, float t) { return vec3(t); }") == missing);
  CHECK(fault_of_camera("vec3 origin(vec2 place, vec2 lens) { return vec3(place, 1.0); }") == missing);
}

TEST_CASE(
    "rays have directions and origins in float32's bits and in float64; the default origin is the eye") {
  const std::string text =
      "vec3 direction(vec2 place, vec2 lens) {\n  place.x *= scale;\n  return vec3(place, 1.0 / 3.0);\n}\n";
  const formula::Formula from_eye = camera(text, {{"scale", {0.1}}});
  CHECK_FALSE(from_eye.has_other());
  CHECK(from_eye.direction(std::array{2.0f, 0.5f, 0.0f, 0.0f}) == std::array{2.0f * 0.1f, 0.5f, 1.0f / 3.0f});
  CHECK(from_eye.origin(std::array{2.0f, 0.5f, 1.0f, 1.0f}) == std::array{0.0f, 0.0f, 0.0f});

  const formula::Formula lens =
      camera(text + "vec3 origin(vec2 place, vec2 lens) { return vec3(lens.y, place.x, lens.x); }",
             {{"scale", {2}}});
  REQUIRE(lens.has_other());
  CHECK(lens.direction(std::array{2.0, 0.5, 0.25, 0.75})[0] == 4);
  CHECK(lens.origin(std::array{2.0, 0.5, 0.25, 0.75}) == std::array{0.75, 2.0, 0.25});
  CHECK(lens.origin(std::array{2.0f, 0.5f, 0.25f, 0.75f}) == std::array{0.75f, 2.0f, 0.25f});
  CHECK(lens.kernel("k_").find("vec3 k_direction(vec4 p) {") != std::string::npos);
  CHECK(lens.kernel("k_").find("vec3 k_origin(vec4 p) {") != std::string::npos);
}
