// Common parts of cylinders, cones and their like: quadrics of revolution about the y axis of object space,
// between two planes across it. In the shaders it is geometry/revolution.glsl.
#pragma once

#include "host/shapes/object_shape.hpp"

namespace eyeray::engine::shapes {

class Revolution : public ObjectShape {
 public:
  bool is_closed() const override { return !open_; }
  ShapeForm form() const override;

 protected:
  // x² + z² = square·y² + 2·linear·y + constant, for bottom ≤ y ≤ top.
  struct Profile {
    double square, linear, constant;
    double bottom, top;

    double radius(double y) const;
  };

  Revolution(uint32_t kind, const Mat4& to_world, const Profile& profile, bool open,
             std::vector<float> parameters = {});

 private:
  Crossings crossings(const Ray& ray) const override;
  Point point(const Vec3& near, const Intersection& hit) const override;
  Bounds extent() const override;

  Profile profile_;
  bool open_;
};

}  // namespace eyeray::engine::shapes
