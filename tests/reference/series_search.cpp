// The reference's search by Chebyshev series finds the same roots as its search by a Lipschitz constant.
#include <cmath>
#include <memory>

#include "host/formula/formula.hpp"
#include "host/shapes/chebyshev.hpp"
#include "host/shapes/formula_surface.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::shapes;
using test::Random;

TEST_CASE("a Chebyshev series bounds its distance from zero, and detects whether it is monotone") {
  const auto series = [](auto f) {
    std::array<double, ChebyshevSeries::points> values;
    for (size_t i = 0; i < values.size(); ++i) values[i] = f(ChebyshevSeries::sample_points()[i]);
    return ChebyshevSeries(values);
  };
  const ChebyshevSeries cubic = series([](double x) { return 3 + x * x * x; });
  CHECK(cubic.ends(1e-14));
  CHECK(cubic.clearance() == doctest::Approx(2));
  CHECK_FALSE(cubic.monotone());  // its slope is 0 in the middle
  CHECK(series([](double x) { return 3 * x + x * x * x / 2; }).monotone());
  CHECK(series([](double x) { return x * x - 0.5; }).clearance() < 0);
  CHECK(series([](double x) { return std::exp(x); }).ends(1e-12));
  CHECK_FALSE(series([](double x) { return std::fabs(x - 0.1); }).ends(1e-3));
}

TEST_CASE("with and without a Lipschitz constant the first change of sign is the same") {
  struct Row {
    const char* text;
    double lipschitz;
  };
  const Row rows[] = {
      {"float f(vec3 p) { return length(p) - 0.7; }", 1},
      {"float f(vec3 p) { return p.x * p.x * p.x + p.y * p.y - 0.4 * p.z; }", 4.1},
      {"float f(vec3 p) { vec3 d = abs(p) - 0.5; return max(d.x, max(d.y, d.z)); }", 1},
      {"float f(vec3 p) { return sin(7.0 * p.x) * cos(5.0 * p.y) + p.z; }", 8.7},
  };
  for (const Row& row : rows) {
    CAPTURE(std::string(row.text));
    const auto formula = std::make_shared<const formula::Formula>(
        formula::FormulaText{row.text, {"f.glsl", 1, 1}}, std::vector<formula::FormulaParameter>(), "f");
    const FormulaUse declared{formula, {Vec3(-1), Vec3(1)}, row.lipschitz}, bare{formula, declared.box, 0};
    Random random(5);
    int found = 0;
    for (int i = 0; i < 1'000; ++i) {
      const Ray ray{random.point(1), random.direction()};
      const auto expected = FormulaSurface(declared).first_change(ray, 0, 1);
      const auto root = FormulaSurface(bare).first_change(ray, 0, 1);
      REQUIRE(root.has_value() == expected.has_value());
      if (!root) continue;
      CHECK_FALSE(root->iteration_limit);
      CHECK(root->s == doctest::Approx(expected->s).epsilon(1e-9));
      ++found;
    }
    CHECK(found > 200);
  }
}
