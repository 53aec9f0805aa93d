// Two balls joined by the cone that touches both: a capsule if they have one radius.
#pragma once

#include <cmath>

#include "host/shapes/object_shape.hpp"

namespace eyeray::engine::shapes {

// Object space: the balls are around the points of the y axis at −half and half, and the larger radius is 1.
struct RoundCone {
  double half = 0;  // 0 if one ball contains the other, which does not count then
  double low = 1, high = 1;

  // The side's normal is (cosine, slope) away from and along the axis.
  double slope() const { return half > 0 ? (low - high) / (2 * half) : 0; }
  double cosine() const { return std::sqrt((1 - slope()) * (1 + slope())); }
};

// v is (ball · φ + side · (y + half)) / whole, for the angle φ of the normal from −y and the ball's centre y
// that is nearest along the normal. On the upper ball φ counts from the side's angle.
struct AlongV {
  double low_ball = 0, high_ball = 0, side = 0;
  double whole = 1;  // length of the surface
};

// Balls at `from` and `to` in a space that `transform` maps to the world; x is the direction of u = ½. The
// radii are not both 0.
struct PlacedRoundCone {
  Mat4 to_world;
  RoundCone cone;
};
PlacedRoundCone place_round_cone(const Vec3& from, const Vec3& to, double low, double high, const Vec3& x,
                                 const Vec3& y);

class Capsule final : public ObjectShape {
 public:
  Capsule(const Mat4& to_world, const RoundCone& cone);

  Bounds bounds() const override;
  bool is_closed() const override { return true; }
  void pack(records::Packer& packer) const override;
  ShapeForm form() const override {
    return CapsuleForm{to_world().matrix(), cone_.half, cone_.low, cone_.high};
  }

 private:
  Crossings crossings(const Ray& ray) const override;
  Point point(const Vec3& near, const Intersection& hit) const override;
  Bounds extent() const override { return {{-1, -cone_.half - 1, -1}, {1, cone_.half + 1, 1}}; }

  // The height of the centre of the ball that touches the surface nearest to p.
  double center_below(const Vec3& p) const;

  RoundCone cone_;
  double slope_, cosine_, middle_;  // the ball around the height y has the radius middle − slope · y
  AlongV v_;
};

}  // namespace eyeray::engine::shapes
