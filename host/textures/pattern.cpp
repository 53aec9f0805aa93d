#include "host/textures/pattern.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "host/records/packer.hpp"
#include "host/textures/registry.hpp"

namespace eyeray::engine::textures {
namespace {

// The twelve gradients of Perlin's "Improving Noise" (2002), four of them twice.
constexpr int slopes[16][3] = {{1, 1, 0},  {-1, 1, 0},  {1, -1, 0}, {-1, -1, 0}, {1, 0, 1},  {-1, 0, 1},
                               {1, 0, -1}, {-1, 0, -1}, {0, 1, 1},  {0, -1, 1},  {0, 1, -1}, {0, -1, -1},
                               {1, 1, 0},  {0, -1, 1},  {-1, 1, 0}, {0, -1, -1}};

double smooth(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

double noise(const Vec3& p) {
  const Vec3 corner = glm::floor(p), in_cell = p - corner;
  const auto along = [&](int x, int y, int z) {
    const Vec3 at(x, y, z);
    const int* slope = slopes[cell_hash(corner + at) % 16];
    return glm::dot(Vec3(slope[0], slope[1], slope[2]), in_cell - at);
  };
  const auto row = [&](int y, int z) { return glm::mix(along(0, y, z), along(1, y, z), smooth(in_cell.x)); };
  const auto layer = [&](int z) { return glm::mix(row(0, z), row(1, z), smooth(in_cell.y)); };
  return glm::mix(layer(0), layer(1), smooth(in_cell.z));
}

shader::uvec4 words(const Vec4& v) {
  const glm::vec4 rounded(v);
  return {std::bit_cast<uint32_t>(rounded.x), std::bit_cast<uint32_t>(rounded.y),
          std::bit_cast<uint32_t>(rounded.z), std::bit_cast<uint32_t>(rounded.w)};
}

}  // namespace

uint32_t next_hash(uint32_t x) {
  const uint32_t state = x * 747796405u + 2891336453u;
  const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return (word >> 22) ^ word;
}

uint32_t cell_hash(const Vec3& corner) {
  const auto number = [](double x) { return uint32_t(int32_t(std::clamp(x, -1e9, 1e9))); };
  return next_hash(number(corner.x) + next_hash(number(corner.y) + next_hash(number(corner.z))));
}

double triangle_wave(double x) {
  return 1 - std::abs(2 * (x - std::floor(x)) - 1);
}

double turbulence(const Vec3& p, int octaves) {
  double sum = 0;
  for (int i = 0; i < octaves; ++i) sum += std::ldexp(noise(std::ldexp(1.0, i) * p), -i);
  return sum;
}

bool pattern_stands(TableReader& table) {
  if (table.failed()) return false;
  const std::string why = why_singular(table.transform("transform"));
  if (!why.empty()) table.error("transform", why);
  return why.empty();
}

Pattern::Pattern(const TableReader& table, uint32_t kind, const Vec4& parameters)
    : to_pattern_(glm::inverse(table.transform("transform"))),
      colors_(table.color_map("colors")),
      kind_(kind),
      parameters_(parameters) {}

Vec3 Pattern::at(const TextureContext& point) const {
  const double t = share(to_pattern_.point(point.position));
  // Find the last color at or below t, and the next one.
  const auto after = std::ranges::find_if(colors_, [&](const Vec4& color) { return color.w > t; });
  if (after == colors_.begin()) return Vec3(colors_.front());
  if (after == colors_.end()) return Vec3(colors_.back());
  const Vec4 &from = after[-1], &to = *after;
  return glm::mix(Vec3(from), Vec3(to), (t - from.w) / (to.w - from.w));
}

// 0.03 of the pattern's own units, in world units. At smaller distances float32 could not distinguish
// heights.
double Pattern::detail() const {
  return 0.03 / std::cbrt(std::fabs(glm::determinant(to_pattern_.linear)));
}

uint32_t Pattern::pack(records::Packer& packer) const {
  // The shaders know positions relative to the eye.
  const Vec3 eye = -packer.relative(Vec3(0)), offset = to_pattern_.point(eye);
  const Mat3 rows = glm::transpose(to_pattern_.linear);
  std::vector<shader::uvec4> data;
  for (int i = 0; i < 3; ++i) data.push_back(words(Vec4(rows[i], offset[i])));
  data.push_back(words(parameters_));
  for (const Vec4& color : colors_) data.push_back(words(color));
  return packer.add(shader::Texture{.color = shader::vec3(0),
                                    .kind = kind_,
                                    .a = shader::vec4(0),
                                    .b = shader::vec4(0),
                                    .c = {packer.add_vertices(data), uint32_t(colors_.size()), 0, 0}});
}

}  // namespace eyeray::engine::textures
