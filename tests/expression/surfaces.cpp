#include "tests/expression/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/shapes/ready_formulas.hpp"

namespace eyeray::engine::test {
namespace {

double square(double x) {
  return x * x;
}

double sphere(const Vec3& p) {
  return glm::dot(p, p) - 1;
}

double tanglecube(const Vec3& p) {
  const auto part = [](double x) { return x * x * x * x - 5 * x * x; };
  return part(p.x) + part(p.y) + part(p.z) + 11.8;
}

double barth_sextic(const Vec3& p) {
  const double t = std::numbers::phi, x = square(p.x), y = square(p.y), z = square(p.z);
  return 4 * (t * t * x - y) * (t * t * y - z) * (t * t * z - x) - (1 + 2 * t) * square(x + y + z - 1);
}

double barth_decic(const Vec3& p) {
  const double t = std::numbers::phi, x = square(p.x), y = square(p.y), z = square(p.z), s = x + y + z;
  return 8 * (x - std::pow(t, 4) * y) * (y - std::pow(t, 4) * z) * (z - std::pow(t, 4) * x) *
             (x * x + y * y + z * z - 2 * (x * y + x * z + y * z)) +
         (3 + 5 * t) * square(s - 1) * square(s - (2 - t));
}

double kummer(const Vec3& p) {
  const double m = 1.3, root = std::numbers::sqrt2;
  return square(glm::dot(p, p) - m) - (3 * m - 1) / (3 - m) * (1 - p.z - root * p.x) *
                                          (1 - p.z + root * p.x) * (1 + p.z + root * p.y) *
                                          (1 + p.z - root * p.y);
}

double steiner(const Vec3& p) {
  return square(p.x * p.y) + square(p.y * p.z) + square(p.z * p.x) + p.x * p.y * p.z;
}

double heart(const Vec3& p) {
  return std::pow(p.x * p.x + 2.25 * p.y * p.y + p.z * p.z - 1, 3) - p.x * p.x * std::pow(p.z, 3) -
         0.1125 * p.y * p.y * std::pow(p.z, 3);
}

double chebyshev(int n, double x) {
  return n == 0 ? 1 : n == 1 ? x : 2 * x * chebyshev(n - 1, x) - chebyshev(n - 2, x);
}
double chmutov(const Vec3& p) {
  return chebyshev(6, p.x) + chebyshev(6, p.y) + chebyshev(6, p.z);
}

double gyroid(const Vec3& p) {
  const Vec3 q = 3.0 * p;
  return std::sin(q.x) * std::cos(q.y) + std::sin(q.y) * std::cos(q.z) + std::sin(q.z) * std::cos(q.x) - 0.1;
}

double metaballs(const Vec3& p) {
  double sum = -1;
  for (const int i : {0, 1, 2})
    sum += std::exp(-2 * square(glm::length(p - Vec3(0.7 * i - 0.6, 0.2 * i, 0.1))));
  return -sum;
}

double twisted_box(const Vec3& p) {
  const double c = std::cos(2 * p.y), s = std::sin(2 * p.y);
  const Vec3 d = glm::abs(Vec3(c * p.x - s * p.z, p.y, s * p.x + c * p.z)) - Vec3(0.5, 1, 0.3);
  return glm::length(glm::max(d, 0.0)) + std::min(std::max({d.x, d.y, d.z}), 0.0) - 0.1;
}

double smooth_union(const Vec3& p) {
  const double a = glm::length(p - Vec3(0.4, 0, 0)) - 0.6,
               b = std::hypot(std::hypot(p.x, p.z) - 0.8, p.y) - 0.2;
  const double h = std::max(0.3 - std::abs(a - b), 0.0) / 0.3;
  return std::min(a, b) - h * h * h * 0.3 / 6;
}

// The Mandelbulb by its angles, as its authors define it.
double mandelbulb(const Vec3& p) {
  Vec3 z = p;
  for (int i = 0; i < 2 && glm::length(z) < 8; ++i) {
    const double r = glm::length(z), tilt = 8 * std::acos(z.y / r), around = 8 * std::atan2(z.z, z.x);
    z = std::pow(r, 8) *
            Vec3(std::sin(tilt) * std::cos(around), std::cos(tilt), std::sin(tilt) * std::sin(around)) +
        p;
  }
  return glm::dot(z, z) - 1;
}

std::string ready_text(std::string_view name) {
  return std::string(std::ranges::find(shapes::ready_formulas(), name, &shapes::ReadyFormula::name)->text);
}

double stairs(const Vec3& p) {
  return p.y - 0.25 * std::floor(4 * p.x) - (p.z - 2 * std::floor(p.z / 2)) * 0.1;
}

}  // namespace

const std::vector<TestSurface>& test_surfaces() {
  static const std::vector<TestSurface> surfaces = {
      {"sphere", "float f(vec3 p) { return dot(p, p) - 1.0; }", sphere, 1.5},
      {"tanglecube", R"(float part(float x) { return x * x * x * x - 5.0 * x * x; }
float f(vec3 p) { return part(p.x) + part(p.y) + part(p.z) + 11.8; })",
       tanglecube, 2.6},
      {"barth sextic", R"(const float t = (1.0 + sqrt(5.0)) / 2.0;
float f(vec3 p) {
  vec3 q = p * p;
  vec3 factors = t * t * q - q.yzx;
  return 4.0 * factors.x * factors.y * factors.z - (1.0 + 2.0 * t) * pow(q.x + q.y + q.z - 1.0, 2.0);
})",
       barth_sextic, 1.8},
      {"barth decic", R"(const float t = (1.0 + sqrt(5.0)) / 2.0;
float f(vec3 p) {
  vec3 q = p * p;
  float s = q.x + q.y + q.z;
  vec3 a = q - pow(t, 4.0) * q.yzx;
  float b = dot(q, q) - 2.0 * dot(q, q.yzx);
  return 8.0 * a.x * a.y * a.z * b + (3.0 + 5.0 * t) * pow(s - 1.0, 2.0) * pow(s - (2.0 - t), 2.0);
})",
       barth_decic, 1.5},
      {"kummer", R"(float f(vec3 p) {
  const float m = 1.3;
  vec2 q = sqrt(2.0) * p.xy;
  float planes = (1.0 - p.z - q.x) * (1.0 - p.z + q.x) * (1.0 + p.z + q.y) * (1.0 + p.z - q.y);
  float s = dot(p, p) - m;
  return s * s - (3.0 * m - 1.0) / (3.0 - m) * planes;
})",
       kummer, 3},
      {"steiner", R"(float f(vec3 p) {
  vec3 q = p * p.yzx;
  return dot(q, q) + p.x * p.y * p.z;
})",
       steiner, 1},
      {"heart", R"(float f(vec3 p) {
  float a = p.x * p.x + 9.0 / 4.0 * p.y * p.y + p.z * p.z - 1.0;
  return a * a * a - (p.x * p.x + 9.0 / 80.0 * p.y * p.y) * p.z * p.z * p.z;
})",
       heart, 1.4},
      {"chmutov", R"(float chebyshev(int n, float x) {
  float values[7];
  values[0] = 1.0;
  values[1] = x;
  for (int i = 2; i <= n; ++i) values[i] = 2.0 * x * values[i - 1] - values[i - 2];
  return values[n];
}
float f(vec3 p) { return chebyshev(6, p.x) + chebyshev(6, p.y) + chebyshev(6, p.z); })",
       chmutov, 1.1},
      {"gyroid", R"(float f(vec3 p) {
  p *= 3.0;
  return dot(sin(p), cos(p.yzx)) - 0.1;
})",
       gyroid, 2},
      {"metaballs", R"(float f(vec3 p) {
  float sum = -1.0;
  for (int i = 0; i < 3; i++) {
    vec3 d = p - vec3(0.7 * float(i) - 0.6, 0.2 * float(i), 0.1);
    sum += exp(-2.0 * dot(d, d));
  }
  return -sum;
})",
       metaballs, 2},
      {"twisted box",
       R"(vec2 turn(vec2 v, float angle) { return vec2(dot(v, vec2(cos(angle), -sin(angle))), dot(v, vec2(sin(angle), cos(angle)))); }
float f(vec3 p) {
  p.xz = turn(p.xz, 2.0 * p.y);
  vec3 d = abs(p) - vec3(0.5, 1.0, 0.3);
  return length(max(d, 0.0)) + min(max(d.x, max(d.y, d.z)), 0.0) - 0.1;
})",
       twisted_box, 1.5},
      {"smooth union", R"(float smooth_min(float a, float b, float k) {
  float h = max(k - abs(a - b), 0.0) / k;
  return min(a, b) - h * h * h * k * (1.0 / 6.0);
}
float torus(vec3 p, vec2 t) { return length(vec2(length(p.xz) - t.x, p.y)) - t.y; }
float f(vec3 p) { return smooth_min(distance(p, vec3(0.4, 0.0, 0.0)) - 0.6, torus(p, vec2(0.8, 0.2)), 0.3); })",
       smooth_union, 1.3},
      {"mandelbulb", "const float rounds = 2.0;\n" + ready_text("mandelbulb"), mandelbulb, 1.3, true},
      {"stairs", "float f(vec3 p) { return p.y - 0.25 * floor(4.0 * p.x) - mod(p.z, 2.0) * 0.1; }", stairs, 2,
       true},
  };
  return surfaces;
}

}  // namespace eyeray::engine::test
