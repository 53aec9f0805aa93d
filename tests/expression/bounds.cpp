// Affine bounds hold every value that the function has on the piece, and are as tight as they promise.
#include <cmath>

#include "host/formula/formula.hpp"
#include "tests/expression/evaluate.hpp"
#include "tests/expression/surfaces.hpp"
#include "tests/support/random.hpp"

#include "tests/support/doctest.hpp"

using namespace eyeray::engine;
using test::Random;

namespace {

struct Piece {
  shader::vec3 o, d;
  float m, h;
  Vec3 at(double s) const { return Vec3(o) + Vec3(d) * (double(m) + double(h) * s); }
};

// A piece of any length that begins or ends within the cube, its values often 0 or 1.
Piece random_piece(Random& random, double reach) {
  Piece piece{shader::vec3(random.point(reach)), shader::vec3(random.direction()), 0, 0};
  if (random.below(8) == 0) piece.o[random.below(3)] = 0;
  if (random.below(8) == 0) piece.d = {};
  if (random.below(8) == 0) piece.d[random.below(3)] = 1;
  piece.m = float(random.below(2) * random.uniform(-reach, reach));
  piece.h = float(random.log_uniform(1e-7, 2) * reach);
  return piece;
}

// The value of a GLSL literal.
double single(double x) {
  return double(float(x));
}

struct Report {
  int pieces = 0, bounded = 0, escaped = 0;
  Vec3 where{};
};

// Counts, among `count` random pieces, those with a sampled point at which f is outside the affine bound.
template <typename F>
Report bound_often(const expression::StraightLine& function, const F& f, double reach, int count) {
  Random random(7);
  Report report;
  for (int i = 0; i < count; ++i) {
    const Piece piece = random_piece(random, reach);
    const shader::vec3 e = test::bound_piece(function, piece.o, piece.d, piece.m, piece.h);
    ++report.pieces;
    report.bounded += e.z < 1e20f;
    for (int k = 0; k < 12; ++k) {
      const double s = k == 0 ? -1 : k == 1 ? 1 : k == 2 ? 0 : random.uniform(-1, 1);
      const double value = f(piece.at(s));
      if (!std::isfinite(value)) continue;  // no value there
      if (std::abs(value - (double(e.x) + double(e.y) * s)) > double(e.z)) {
        ++report.escaped;
        report.where = piece.at(s);
        break;
      }
    }
  }
  return report;
}

}  // namespace

TEST_CASE("bounds of surfaces enclose every value, in 20 000 pieces each") {
  for (const test::TestSurface& surface : test::test_surfaces()) {
    CAPTURE(surface.name);
    const formula::Formula formula({surface.glsl, {}}, {}, "it");
    const auto f = [&](const Vec3& p) { return formula.value(std::array{p.x, p.y, p.z}); };
    const Report report = bound_often(formula.straight_line(), f, surface.reach, 20'000);
    CAPTURE(report.where.x);
    CAPTURE(report.where.y);
    CAPTURE(report.where.z);
    CHECK(report.escaped == 0);
    CHECK(report.bounded > report.pieces / 2);
  }
}

TEST_CASE("bounds of each GLSL function enclose every value, in 10 000 pieces") {
  struct Row {
    const char* glsl;
    double (*f)(double x, double y, double z);
    double reach = 2;
  };
  using std::floor, std::abs, std::sqrt;
  const auto clamp = [](double x) { return std::min(std::max(x, 0.0), 1.0); };
  static const auto unit = clamp;
  const Row rows[] = {
      {"x + y - z", [](double x, double y, double z) { return x + y - z; }},
      {"-x * y / z", [](double x, double y, double z) { return -x * y / z; }},
      {"x * x * x + 0.1 * y", [](double x, double y, double) { return x * x * x + single(0.1) * y; }},
      {"abs(x) + sign(y)", [](double x, double y, double) { return abs(x) + (y > 0) - (y < 0); }},
      {"floor(x) + ceil(y) + fract(z)",
       [](double x, double y, double z) { return floor(x) + std::ceil(y) + z - floor(z); }},
      {"trunc(x) + mod(y, 0.7)",
       [](double x, double y, double) { return std::trunc(x) + y - single(0.7) * floor(y / single(0.7)); }},
      {"sqrt(x) + inversesqrt(y)", [](double x, double y, double) { return sqrt(x) + 1 / sqrt(y); }},
      {"min(x, max(y, z))", [](double x, double y, double z) { return std::min(x, std::max(y, z)); }},
      {"clamp(x, 0.0, 1.0) * mix(y, z, 0.3)",
       [](double x, double y, double z) { return unit(x) * (y + single(0.3) * (z - y)); }},
      {"step(x, y) + smoothstep(-0.5, 1.5, z)",
       [](double x, double y, double z) {
         const double t = unit((z + 0.5) / 2);
         return (y < x ? 0 : 1) + t * t * (3 - 2 * t);
       }},
      {"sin(x) + cos(y)", [](double x, double y, double) { return std::sin(x) + std::cos(y); }, 20},
      {"tan(x)", [](double x, double, double) { return std::tan(x); }, 1},
      {"asin(x) + acos(y)", [](double x, double y, double) { return std::asin(x) + std::acos(y); }, 1},
      {"atan(x) + atan(y, z)", [](double x, double y, double z) { return std::atan(x) + std::atan2(y, z); }},
      {"exp(x) + log(y)", [](double x, double y, double) { return std::exp(x) + std::log(y); }, 5},
      {"exp2(x) + log2(y)", [](double x, double y, double) { return std::exp2(x) + std::log2(y); }, 5},
      {"sinh(x) + cosh(y) + tanh(z)",
       [](double x, double y, double z) { return std::sinh(x) + std::cosh(y) + std::tanh(z); }},
      {"tanh(100.0 * x) + tanh(y + 100.0)",
       [](double x, double y, double) { return std::tanh(100 * x) + std::tanh(y + 100); }},
      {"pow(x, 5.0) + pow(y, -2.0)",
       [](double x, double y, double) { return std::pow(x, 5) + std::pow(y, -2); }},
      {"pow(abs(x), 2.2) + pow(abs(y), 0.7)",
       [](double x, double y, double) {
         return std::pow(abs(x), single(2.2)) + std::pow(abs(y), single(0.7));
       }},
      {"pow(x, y)", [](double x, double y, double) { return std::pow(x, y); }},
      {"length(vec2(x, y)) + distance(vec2(x, y), vec2(z, 1.0))",
       [](double x, double y, double z) { return std::hypot(x, y) + std::hypot(x - z, y - 1); }},
      {"normalize(vec2(x, y)).x + cross(vec3(x, y, z), vec3(1.0, 2.0, 3.0)).y",
       [](double x, double y, double z) { return x / std::hypot(x, y) + z - 3 * x; }},
      {"reflect(vec3(x, y, z), vec3(0.0, 1.0, 0.0)).y", [](double, double y, double) { return -y; }},
      {"radians(x) + degrees(y)",
       [](double x, double y, double) { return x * 0.017453292519943295 + y * 57.29577951308232; }},
      {"x < y && z > 0.0 || !(x <= 1.0) ? x * y : z",
       [](double x, double y, double z) { return (x < y && z > 0) || !(x <= 1) ? x * y : z; }},
      {"x != y && (x < z || y < 0.5) ? 1.0 : 2.0",
       [](double x, double y, double z) { return x != y && (x < z || y < 0.5) ? 1.0 : 2.0; }},
  };
  for (const Row& row : rows) {
    CAPTURE(std::string(row.glsl));
    const expression::StraightLine function = test::straight_line(
        fmt::format("float f(vec3 p) {{ float x = p.x, y = p.y, z = p.z; return {}; }}", row.glsl));
    const Report report =
        bound_often(function, [&](const Vec3& p) { return row.f(p.x, p.y, p.z); }, row.reach, 10'000);
    CAPTURE(report.where.x);
    CAPTURE(report.where.y);
    CAPTURE(report.where.z);
    CHECK(report.escaped == 0);
    CHECK(report.bounded > report.pieces / 8);
  }
}

TEST_CASE(
    "a product of equal factors is bounded as a square, and affine bounds shrink with the piece's square") {
  const expression::StraightLine square = test::straight_line("float f(vec3 p) { return p.x * p.x; }");
  const shader::vec3 e = test::bound_piece(square, {}, {1, 0, 0}, 0, 1);
  CHECK(e.x == doctest::Approx(0.5));
  CHECK(e.y == 0);
  CHECK(e.z == doctest::Approx(0.5));

  for (const test::TestSurface& surface : test::test_surfaces()) {
    if (surface.jumps || surface.name == "twisted box") continue;  // it jumps, or has a crease there
    CAPTURE(surface.name);
    const expression::StraightLine function = test::straight_line(surface.glsl);
    const auto error = [&](float h) {
      return test::bound_piece(function, {0.31f, 0.42f, 0.23f}, {0.6f, 0, 0.8f}, 0, h).z;
    };
    CHECK(error(0.02f) / error(0.01f) == doctest::Approx(4).epsilon(0.2));
  }
}
