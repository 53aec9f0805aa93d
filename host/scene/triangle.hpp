// One triangle in float64: the part common to the triangle shape and the triangles of meshes.
#pragma once

#include <array>
#include <optional>

#include "host/core/vec.hpp"
#include "host/scene/affine.hpp"
#include "host/scene/shape.hpp"

namespace eyeray::engine {

using Corners = std::array<Vec3, 3>;

// A triangle thinner than this has no usable normal.
inline constexpr double thinnest_triangle = 1e-9;

// The least cosine between a shading normal at a corner and the triangle's own: below, it counts as pointing
// away.
inline constexpr double least_normal_cosine = 1e-6;

// Twice the area over the square of the longest edge; 0 where corners coincide or lie on one line.
double thickness(const Corners& corners);

// The unit normal by counter-clockwise winding, for any triangle whose thickness is at least
// `thinnest_triangle`.
Vec3 geometric_normal(const Corners& corners);

// The gradients of coordinates that are linear over the triangle, from their values at its corners.
struct UvGradients {
  Vec3 u, v;
};
UvGradients uv_gradients(const Corners& corners, const std::array<Vec2, 3>& uv);
// The derivatives of a point of the triangle by u and v, the inverse of the gradients; 0 if the mapping is
// not one to one.
std::pair<Vec3, Vec3> along_uv(const Corners& corners, const std::array<Vec2, 3>& uv);
// The uv of a triangle that has none: the weights of the second and third corner.
inline constexpr std::array<Vec2, 3> corner_weights{Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)};

// Sets `normal` and `lift` of a point of a triangle with normals at its corners, which have any length but 0.
// `weights`: those of the corners at the point, whose normal_geometric is known.
void set_smooth(SurfacePoint& point, const Corners& corners, const Corners& normals,
                const std::array<double, 3>& weights);

// Sets `edges` and `weights` of the point that was hit.
void set_edges(SurfacePoint& point, const Corners& corners, const Intersection& hit);

// Maps the shading normals at the corners of a triangle that `map` maps. Interpolating between the results
// equals interpolating in the object's space and then mapping, since the map is linear. The results are no
// longer unit: their lengths are about 1 at most, and count in the interpolation. Under a similarity they
// stay unit.
class CornerNormals {
 public:
  explicit CornerNormals(const Affine& map);

  // `normal` is unit.
  Vec3 operator()(const Vec3& normal) const {
    return keeps_angles_ ? unit(linear_ * normal) : linear_ * normal;
  }

 private:
  bool keeps_angles_;
  Mat3 linear_;  // the map's inverse transpose, its largest component 1 unless it keeps angles
};

// The ray's hit of the triangle, edges included, with the weights of the second and third corner. `normal`
// is perpendicular to the triangle, of any length but 0. Watertight: a ray never passes between two triangles
// that share an edge. Woop, Benthin and Wald: Watertight Ray/Triangle Intersection, JCGT 2(1), 2013.
std::optional<Intersection> intersect_triangle(const Corners& corners, const Vec3& normal, const Ray& ray);

}  // namespace eyeray::engine
