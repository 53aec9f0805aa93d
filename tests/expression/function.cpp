// Tests of the straight-line code made from GLSL, of the code refused, and of its text and gradient.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <regex>

#include "host/expression/emit.hpp"
#include "host/gpu/shader_compiler.hpp"
#include "host/twin/straight_line.hpp"
#include "tests/expression/evaluate.hpp"
#include "tests/expression/surfaces.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using test::Random;

namespace {

std::string refusal(const std::string& glsl) {
  try {
    test::straight_line(glsl);
  } catch (const InputError& error) {
    const Diagnostic& first = error.diagnostics()[0];
    return fmt::format(
        "{}:{}: {}", first.position.file, first.position.line,
        first.message.substr(0, first.message.find("; so no interval can be computed for it")));
  }
  return "";
}

}  // namespace

TEST_CASE("an expression computes the value of its text") {
  for (const test::TestSurface& surface : test::test_surfaces()) {
    CAPTURE(surface.name);
    const expression::StraightLine function = test::straight_line(surface.glsl);
    Random random(3);
    double worst = 0, largest = 0;
    for (int i = 0; i < 2'000; ++i) {
      const Vec3 p = random.point(surface.reach);
      const double value = surface.f(p);
      if (std::isnan(value)) continue;
      worst = std::max(worst, std::abs(test::evaluate(function, p) - value));
      largest = std::max(largest, std::abs(value));
    }
    CHECK(worst <= 1e-6 * largest);  // the rounding of constants to float32
  }
}

TEST_CASE("the gradient is the derivative") {
  for (const test::TestSurface& surface : test::test_surfaces()) {
    CAPTURE(surface.name);
    const expression::StraightLine function = test::straight_line(surface.glsl);
    Random random(4);
    int compared = 0;
    double worst = 0;
    for (int i = 0; i < 2'000; ++i) {
      const Vec3 p = Vec3(glm::vec3(random.point(surface.reach)));
      const double step = 1e-4;
      Vec3 difference, coarse;
      for (const int axis : {0, 1, 2}) {
        Vec3 offset(0);
        offset[axis] = step;
        difference[axis] = (surface.f(p + offset) - surface.f(p - offset)) / (2 * step);
        coarse[axis] = (surface.f(p + 2.0 * offset) - surface.f(p - 2.0 * offset)) / (4 * step);
      }
      // Skips points with an edge of the function nearby.
      if (!(glm::length(difference - coarse) <= 1e-3 * (1 + glm::length(difference)))) continue;
      const shader::vec4 dual = twin::differentiate(function, shader::vec3(p));
      worst = std::max(worst, glm::length(Vec3(dual) - difference) / (1 + glm::length(difference)));
      ++compared;
    }
    CHECK(worst < 2e-3);
    CHECK(compared > 1'000);
  }
}

TEST_CASE("the generated texts compile as GLSL") {
  const gpu::SourceProvider shaders = [](std::string_view path) -> std::optional<std::string> {
    std::ifstream file("shaders/" + std::string(path));
    if (!file) return std::nullopt;
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  for (const test::TestSurface& surface : test::test_surfaces()) {
    CAPTURE(surface.name);
    const expression::StraightLine function = test::straight_line(surface.glsl);
    const std::string text =
        "#include \"shapes/implicit/bound_march.glsl\"\n#include \"math/dual.glsl\"\n"
        "layout(set = 0, binding = 0) buffer Values { vec4 values[2]; };\n" +
        expression::bound_text(function, "enclosed") + expression::gradient_text(function, "gradient") +
        "void main() { values[0] = gradient(vec3(values[1])); values[1].xyz = enclosed(values[0].xyz, "
        "values[1].xyz, values[1].xyz); }";
    const auto provider = [&](std::string_view path) { return path == "all.glsl" ? text : shaders(path); };
    CHECK_NOTHROW(gpu::compile_shader(gpu::read_shader(provider, "all.glsl"), ""));
  }
}

TEST_CASE("loops, calls and branches become straight-line code") {
  const auto text = [](const std::string& glsl) {
    const expression::StraightLine function = test::straight_line(glsl);
    return expression::bound_text(function, "f");
  };
  CHECK(text("float f(vec3 p) { float s = 0.0; for (int i = 0; i < 3; ++i) { if (i == 1) continue; s += "
             "p[i]; } return s; }") ==
        "vec3 f(vec3 x, vec3 y, vec3 z) {\n  vec3 v0 = x;\n  vec3 v1 = z;\n  vec3 v2 = bound_add(v0, "
        "v1);\n  return v2;\n}\n");
  // A branch whose condition is constant leaves no code; any other becomes a choice. An early return ends the
  // computation.
  CHECK(text("float f(vec3 p) { if (1.0 < 2.0) return p.x; return p.y / 0.0; }") ==
        "vec3 f(vec3 x, vec3 y, vec3 z) {\n  vec3 v0 = x;\n  return v0;\n}\n");
  const std::string early = text("float f(vec3 p) { if (p.x < 0.0) return p.y; return p.z; }");
  CAPTURE(early);
  std::smatch less;
  CHECK(std::regex_search(early, less, std::regex(R"(uint (v\d) = bound_less\()")));
  CHECK(early.find(fmt::format("bound_choose({},", less[1].str())) != std::string::npos);
  // A literal has the float32 value that it has in kernels.
  CHECK(text("float f(vec3 p) { return 0.1; }").find("vec3(1.000000015e-01f, 0.0f, 0.0") !=
        std::string::npos);
}

TEST_CASE("code that cannot become straight-line code is refused, at its line") {
  CHECK(refusal("float f(vec3 p) {\n  while (p.x > 1.0) p.x *= 0.5;\n  return p.x;\n}") ==
        "f.glsl:11: this loop has more than 1000 iterations, or a number of them that depends on p");
  CHECK(refusal("float f(vec3 p) {\n  int i = int(p.x);\n  return p[i];\n}") ==
        "f.glsl:11: a whole number is computed from p");
  CHECK(refusal("float f(vec3 p) {\n  int i = p.x < 0.0 ? 1 : 2;\n\n  return p[i];\n}") ==
        "f.glsl:13: an array's or vector's index is computed from p");
  CHECK(refusal("float f(vec3 p) {\n  float x = p.x;\n  for (int i = 0; i < 99; ++i)\n    for (int k = 0; k "
                "< 999; ++k) "
                "x = sin(x) + p.y;\n  return x;\n}") ==
        "f.glsl:13: with all iterations of its loops the function is too long");

  CHECK(refusal("float f(vec3 p) {\n  return length(q);\n}")
            .starts_with("f.glsl:11: 'q': undeclared identifier"));
}
