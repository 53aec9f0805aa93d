#include "host/scene/affine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace eyeray::engine {

namespace {

double frobenius(const glm::dmat3& m) {
  return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
}

}  // namespace

double magnitude(const Vec3& v) {
  return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
}

Vec3 unit(const Vec3& v) {
  return glm::normalize(v / magnitude(v));
}

Affine::Affine(const Mat4& transform)
    : linear(transform), offset(transform[3]), cotangent(glm::transpose(glm::inverse(linear))) {}

std::optional<Similarity> similarity(const Mat4& transform) {
  const Affine affine(transform);

  // Compare the Gram matrix with scale² · 1.
  const double scale = std::cbrt(std::fabs(glm::determinant(affine.linear)));
  const Mat3 linear = affine.linear / scale;
  const Mat3 gram = glm::transpose(linear) * linear;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      if (!(std::fabs(gram[column][row] - (column == row ? 1.0 : 0.0)) <= 1e-6)) return std::nullopt;

  // Make the axes orthonormal to the last bit, the pole first.
  const Vec3 y = unit(linear[1]);
  const Vec3 x = unit(linear[0] - y * glm::dot(linear[0], y));
  const Vec3 z = affine.mirrors() ? glm::cross(y, x) : glm::cross(x, y);
  return Similarity{Mat3(x, y, z), scale, affine.offset};
}

double condition(const Mat3& linear) {
  return frobenius(linear) * frobenius(glm::inverse(linear));
}

double thinning(const Mat3& linear) {
  return std::fabs(glm::determinant(linear / frobenius(linear)));
}

std::string why_singular(const Mat4& map) {
  const glm::dmat3 linear(map);
  const double size = frobenius(linear);
  const double determinant = glm::determinant(linear);
  if (!std::isfinite(size) || !std::isfinite(determinant) || size > largest_number)
    return "its numbers are too large";
  if (!(size >= 1 / largest_number)) return "it shrinks everything to a point";
  if (determinant == 0) return "it flattens space (its determinant is 0)";
  if (const double stretch = condition(linear); !(stretch <= worst_condition))
    return fmt::format("it nearly flattens space (condition number {:.1e})", stretch);
  if (!(glm::length(Vec3(map[3])) <= largest_number)) return "it moves things too far";
  return "";
}

}  // namespace eyeray::engine
