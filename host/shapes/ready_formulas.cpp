#include "host/shapes/ready_formulas.hpp"

#include <cmath>
#include <numbers>

namespace eyeray::engine::shapes {

namespace {

using Parameters = std::span<const formula::FormulaParameter>;

double number(const formula::FormulaParameter& parameter) {
  return parameter.values[0];
}

// Wyvill, McPheeters, Wyvill: Data structure for soft objects, The Visual Computer 2, 1986: (1 − (r/R)²)³
// about each centre. That is steepest at r = R / √5: 96 / (25 √5) / R.
constexpr std::string_view metaballs = R"glsl(
float weight(vec3 p, vec4 ball) {
  vec3 v = p - ball.xyz;
  float d = max(1.0 - dot(v, v) / (ball.w * ball.w), 0.0);
  return d * d * d;
}
float f(vec3 p) { return level - weight(p, ball1) - weight(p, ball2) - weight(p, ball3) - weight(p, ball4); }
vec3 fall(vec3 p, vec4 ball) {
  vec3 v = p - ball.xyz;
  float square = ball.w * ball.w;
  float d = max(1.0 - dot(v, v) / square, 0.0);
  return v * (6.0 * d * d / square);
}
vec3 gradient(vec3 p) { return fall(p, ball1) + fall(p, ball2) + fall(p, ball3) + fall(p, ball4); }
)glsl";
double steepest_metaballs(Parameters parameters) {
  double sum = 0;
  for (const formula::FormulaParameter& ball : parameters.first(4)) sum += 1 / std::fabs(ball.values[3]);
  return 96 / (25 * std::sqrt(5.0)) * sum;
}

// Schoen: Infinite Periodic Minimal Surfaces Without Self-Intersections, NASA TN D-5541, 1970; its first
// Fourier terms. Each of the three derivatives is cos a cos b − sin c sin d, and so within ±1.
constexpr std::string_view gyroid = R"glsl(
const float TURN = 6.28318530717958648;
float f(vec3 p) {
  vec3 q = p * (TURN / period);
  float sheet = dot(sin(q), cos(q.yzx)) - level;
  return (abs(sheet) - thickness) * (period / TURN);
}
vec3 gradient(vec3 p) {
  vec3 q = p * (TURN / period);
  vec3 s = sin(q);
  vec3 c = cos(q);
  float side = dot(s, c.yzx) < level ? -1.0 : 1.0;
  return (c * c.yzx - s * s.zxy) * side;
}
)glsl";
double steepest_gyroid(Parameters) {
  return std::numbers::sqrt3;
}

// A distance function, and so nowhere steeper than 1. Quilez: Distance Functions,
// https://iquilezles.org/articles/distfunctions.
constexpr std::string_view rounded_box = R"glsl(
float f(vec3 p) {
  vec3 q = abs(p - center) - (half_size - radius);
  return length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0) - radius;
}
vec3 gradient(vec3 p) {
  vec3 q = abs(p - center) - (half_size - radius);
  vec3 outer = max(q, 0.0);
  vec3 face = q.x >= q.y && q.x >= q.z ? vec3(1.0, 0.0, 0.0) : q.y >= q.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
  float far = length(outer);
  return sign(p - center) * (far > 0.0 ? outer / far : face);
}
)glsl";

// A ball and a box, blended by a polynomial (Quilez: Smooth Minimum, https://iquilezles.org/articles/smin):
// the gradient is a mean of theirs.
constexpr std::string_view smooth_union = R"glsl(
float ball(vec3 p) { return distance(p, sphere.xyz) - sphere.w; }
float brick(vec3 p) {
  vec3 q = abs(p - box_center) - box_half_size;
  return length(max(q, 0.0)) + min(max(q.x, max(q.y, q.z)), 0.0);
}
float f(vec3 p) {
  float a = ball(p);
  float b = brick(p);
  float share = clamp(0.5 + 0.5 * (b - a) / blend, 0.0, 1.0);
  return mix(b, a, share) - blend * share * (1.0 - share);
}
vec3 brick_gradient(vec3 p) {
  vec3 q = abs(p - box_center) - box_half_size;
  vec3 outer = max(q, 0.0);
  vec3 face = q.x >= q.y && q.x >= q.z ? vec3(1.0, 0.0, 0.0) : q.y >= q.z ? vec3(0.0, 1.0, 0.0) : vec3(0.0, 0.0, 1.0);
  float far = length(outer);
  return sign(p - box_center) * (far > 0.0 ? outer / far : face);
}
vec3 gradient(vec3 p) {
  float share = clamp(0.5 + 0.5 * (brick(p) - ball(p)) / blend, 0.0, 1.0);
  return mix(brick_gradient(p), normalize(p - sphere.xyz), share);
}
)glsl";
double steepest_distance(Parameters) {
  return 1;
}

// White and Nylander's bulb: z → z⁸ + p, eight times both angles of spherical coordinates about y; they are
// doubled thrice, by polynomials. The bulb is where |z| ≤ 1 after so many iterations. |z|'s slope has no
// useful bound, so intervals find the bulb. The bounds by min, max and clamp hold in real numbers anyway;
// intervals need them in the text. Each bound leaves some room: float32 rounds by less, and so never takes
// the slope of a bound for that of f.
constexpr std::string_view mandelbulb = R"glsl(
float f(vec3 p) {
  float origin = length(p);
  vec3 z = p;
  float r2 = dot(p, p);
  for (int i = 0; i < int(min(rounds, 8.0)); i++) {
    if (r2 > 64.0) break;
    float across2 = z.x * z.x + z.z * z.z;
    float r4 = r2 * r2;
    float r8 = r4 * r4;

    // Cosines, times r², r⁴, r⁸, and the sine, times r⁸ over the sine of the angle itself.
    float cosine2 = z.y * z.y - across2;
    float cosine4 = 2.0 * cosine2 * cosine2 - r4;
    float cosine8 = 2.0 * cosine4 * cosine4 - r8;
    float sine8 = 8.0 * z.y * cosine2 * cosine4;

    float share = 1.0 / max(across2, 1.0e-12);
    float c = clamp((z.x * z.x - z.z * z.z) * share, -1.000001, 1.000001);
    float s = clamp(2.0 * z.x * z.z * share, -1.000001, 1.000001);
    for (int k = 0; k < 2; k++) {
      s = 2.0 * c * s;
      c = 2.0 * c * c - 1.0;
    }
    z = vec3(sqrt(across2) * sine8 * vec2(c, s), cosine8).xzy + p;
    float least = max(r8 - origin, 0.0);
    float most = r8 + origin;
    r2 = clamp(dot(z, z), 0.99999 * least * least, 1.00001 * most * most);
  }
  return r2 - 1.0;
}
)glsl";

// Sums of value noise (Perlin's lattice with values at its corners), each octave twice as fine and half as
// high. The fifth-degree easing curve along each of the two axes is steepest in the middle: 15/8.
constexpr std::string_view height_field = R"glsl(
float corner(int x, int z) {
  uint h = uint(x) * 1597334677u ^ uint(z) * 3812015801u ^ uint(int(seed)) * 2654435769u;
  h = (h ^ (h >> 15u)) * 2246822519u;
  h = (h ^ (h >> 13u)) * 3266489917u;
  h = h ^ (h >> 16u);
  return float(h >> 8u) / 16777216.0;
}
float noise(vec2 p) {
  vec2 cell = floor(p);
  vec2 t = p - cell;
  vec2 s = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
  int x = int(cell.x);
  int z = int(cell.y);
  return mix(mix(corner(x, z), corner(x + 1, z), s.x), mix(corner(x, z + 1), corner(x + 1, z + 1), s.x), s.y);
}
float f(vec3 p) {
  float sum = 0.0;
  float scale = 1.0;
  for (int i = 0; i < 5; i++) {
    sum += (noise(p.xz * (scale / period) + float(i) * 17.0) - 0.5) / scale;
    scale *= 2.0;
  }
  return p.y - base - height * sum;
}

vec2 slope(vec2 p) {
  vec2 cell = floor(p);
  vec2 t = p - cell;
  vec2 s = t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
  vec2 steep = 30.0 * t * t * (t * (t - 2.0) + 1.0);
  int x = int(cell.x);
  int z = int(cell.y);
  float a = corner(x, z);
  float b = corner(x + 1, z);
  float c = corner(x, z + 1);
  float twist = a - b - c + corner(x + 1, z + 1);
  return steep * (vec2(b, c) - a + twist * s.yx);
}
vec3 gradient(vec3 p) {
  vec2 sum = vec2(0.0);
  float scale = 1.0;
  for (int i = 0; i < 5; i++) {
    sum += slope(p.xz * (scale / period) + float(i) * 17.0);
    scale *= 2.0;
  }
  sum *= height / period;
  return vec3(-sum.x, 1.0, -sum.y);
}
)glsl";
double steepest_height_field(Parameters parameters) {
  const double slope =
      5 * 1.875 * std::numbers::sqrt2 * std::fabs(number(parameters[1]) / number(parameters[2]));
  return std::sqrt(1 + slope * slope);
}

}  // namespace

std::span<const ReadyFormula> ready_formulas() {
  static const std::vector<ReadyFormula> all = {
      {ready_names[0],
       metaballs,
       {{"ball1", {-0.4, 0, 0, 0.9}},
        {"ball2", {0.4, 0.1, 0.1, 0.9}},
        {"ball3", {0, 0.6, 0, 0.8}},
        {"ball4", {0, -0.3, 0.5, 0.7}},
        {"level", {0.3}}},
       steepest_metaballs},
      {ready_names[1], gyroid, {{"period", {1}}, {"thickness", {0.25}}, {"level", {0}}}, steepest_gyroid},
      {ready_names[2],
       rounded_box,
       {{"center", {0, 0, 0}}, {"half_size", {0.8, 0.6, 0.7}}, {"radius", {0.2}}},
       steepest_distance},
      {ready_names[3],
       smooth_union,
       {{"sphere", {0, 0.35, 0, 0.5}},
        {"box_center", {0, -0.4, 0}},
        {"box_half_size", {0.8, 0.25, 0.6}},
        {"blend", {0.4}}},
       steepest_distance},
      {ready_names[4], mandelbulb, {{"rounds", {2}}}, nullptr},
      {ready_names[5],
       height_field,
       {{"base", {0}}, {"height", {0.5}}, {"period", {1}}, {"seed", {1}}},
       steepest_height_field},
  };
  return all;
}

}  // namespace eyeray::engine::shapes
