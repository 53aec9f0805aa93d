// The affine maps that a shape's `transform` may be, and the limits within which shapes are computed.
#pragma once

#include <optional>
#include <string>

#include "host/core/vec.hpp"

namespace eyeray::engine {

using Mat3 = glm::dmat3;

// Coordinates and sizes beyond these limits overflow float32 in the products that intersections compute.
inline constexpr double max_coordinate = 1e12;
inline constexpr double min_radius = 1e-12;
// Numbers beyond this limit have squares that overflow float32 arithmetic, and positive numbers below its
// inverse vanish.
inline constexpr double largest_number = 1e15;

// The largest magnitude of the components.
double magnitude(const Vec3& v);

// v / |v|, for any finite v ≠ 0, however long or short.
Vec3 unit(const Vec3& v);

// An invertible map of world space; the loader ensures that it is invertible.
struct Affine {
  explicit Affine(const Mat4& transform);

  Mat4 matrix() const { return {{linear[0], 0}, {linear[1], 0}, {linear[2], 0}, {offset, 1}}; }
  Vec3 point(const Vec3& p) const { return linear * p + offset; }
  Vec3 normal(const Vec3& n) const { return unit(cotangent * n); }
  bool mirrors() const { return glm::determinant(linear) < 0; }

  Mat3 linear;
  Vec3 offset;
  Mat3 cotangent;  // the inverse transpose of `linear`: maps normals and gradients
};

// A map that keeps angles: rotation, translation, one scale, perhaps a mirror.
struct Similarity {
  Mat3 axes;  // the images of x, y, z: orthonormal; left-handed under a mirror
  double scale;
  Vec3 offset;

  Vec3 point(const Vec3& p) const { return axes * p * scale + offset; }
};

// `transform` as a similarity (to 1e-6, so that matrices may be written by hand); nothing when it is none.
std::optional<Similarity> similarity(const Mat4& transform);

// The ratio by which the map stretches one direction more than another, at least 3: its Frobenius norm times
// that of its inverse. Beyond `worst_condition` the float32 inverse that the shaders use has no correct digit
// left.
double condition(const Mat3& linear);
inline constexpr double worst_condition = 1e7;

// The least factor, |det| / σ³, by which the map changes the ratio of an area to its size², or of a volume to
// its size³. Here σ is the Frobenius norm, which is no less than the greatest stretch.
double thinning(const Mat3& linear);

// The reason why the map cannot be inverted in float32, such as "it shrinks everything to a point"; "" if it
// can.
std::string why_singular(const Mat4& transform);

}  // namespace eyeray::engine
