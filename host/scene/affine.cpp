#include "host/scene/affine.hpp"

#include <algorithm>
#include <cmath>

namespace eyeray {

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

}  // namespace eyeray
