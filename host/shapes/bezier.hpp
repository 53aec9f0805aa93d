// A bicubic Bézier patch, alone or as part of a lathe.
#pragma once

#include "host/scene/shape.hpp"
#include "host/shapes/bezier_net.hpp"

namespace eyeray::engine::shapes {

// The thickness of a net: the height of the largest triangle of control points that contains the two farthest
// apart, over the distance of these two. 0 if all lie on a line.
double thickness(const BezierNet& net);
inline constexpr double least_bezier_thickness = 1e-5;

class Bezier final : public Shape {
 public:
  // `mirrored`: the normal is that of ∂v × ∂u. `uv`: the range of the texture coordinates.
  Bezier(const BezierNet& net, bool mirrored, const BezierRange& uv = {})
      : net_(net), mirrored_(mirrored), uv_(uv) {}

  std::optional<Intersection> intersect(const Ray& ray) const override;
  SurfacePoint surface(const Ray& ray, const Intersection& hit) const override;
  Bounds bounds() const override;
  ShapeForm form() const override { return BezierForm{net_}; }
  bool counts_crossings() const override { return true; }
  // The degree of its equation in x, y and z.
  int most_crossings() const override { return 2 * 3 * 3; }
  double thickness_margin() const override { return thickness(net_) / least_bezier_thickness; }
  void pack(records::Packer& packer) const override { pack_of(packer, material); }
  // Packs it as part of a shape of this material.
  void pack_of(records::Packer& packer, int of_material) const;

 private:
  Vec3 normal(const BezierPoint& at, const Vec2& uv) const;

  BezierNet net_;
  bool mirrored_;
  BezierRange uv_;
};

}  // namespace eyeray::engine::shapes
