// The cube from −1 to 1 in object space: a box, or the cube that cuts another shape. In the shaders it is
// geometry/cube.glsl.
#pragma once

#include <optional>

#include "host/scene/shape.hpp"

namespace eyeray::engine::shapes::cube {

// A face by its number: 2 · axis, and 1 more for the upper.
struct Crossing {
  double t;
  int face;
};
struct Span {
  Crossing in, out;
};

// The span of a line within the cube; empty if it passes by.
std::optional<Span> span(const Ray& ray);

// The map from the cube to the box with these two corners in another space.
Mat4 placed(const Vec3& min, const Vec3& max);

Vec3 normal(int face);
// The point of the face that is nearest to `near`.
Vec3 onto(int face, const Vec3& near);
// Each face has the texture upright: seen from outside u runs to the right and v up; the upper edge of the
// top face is at −z, that of the bottom face at +z.
Vec2 uv(int face, const Vec3& p);
// The derivatives by u and v of a point on a surface that has the uv of a face. `gradient` is perpendicular
// to the surface.
std::pair<Vec3, Vec3> along_uv(int face, const Vec3& gradient);

}  // namespace eyeray::engine::shapes::cube
