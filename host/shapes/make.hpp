// Shapes built in code, by importers and tests; a scene file's go through their ShapeType. Arguments that
// `parse` would reject are a broken promise here.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "host/scene/point_cloud.hpp"
#include "host/scene/shape.hpp"
#include "host/shapes/planar_region.hpp"

namespace eyeray::engine::shapes {

// Returns an ellipsoid if `transform` is no similarity.
std::unique_ptr<Shape> make_sphere(const Vec3& center, double radius, const Mat4& transform = Mat4(1.0));

// Without `u_axis`, the default that the manual names.
std::unique_ptr<Shape> make_plane(const Vec3& point, const Vec3& normal, const Mat4& transform = Mat4(1.0),
                                  const std::optional<Vec3>& u_axis = {});

struct TriangleValues {
  std::array<Vec3, 3> vertices;
  std::optional<std::array<Vec3, 3>> normals = {};  // any length but 0
  std::optional<std::array<Vec2, 3>> uv = {};
};
std::unique_ptr<Shape> make_triangle(const TriangleValues& values, const Mat4& transform = Mat4(1.0));

std::unique_ptr<Shape> make_box(const Vec3& min, const Vec3& max, const Mat4& transform = Mat4(1.0));
std::unique_ptr<Shape> make_ellipsoid(const Vec3& center, const Vec3& radii,
                                      const Mat4& transform = Mat4(1.0));
std::unique_ptr<Shape> make_cylinder(const Vec3& from, const Vec3& to, double radius, bool open = false,
                                     const Mat4& transform = Mat4(1.0));
std::unique_ptr<Shape> make_cone(Vec3 from, Vec3 to, double radius, double to_radius = 0, bool open = false,
                                 const Mat4& transform = Mat4(1.0));
std::unique_ptr<Shape> make_disk(const Vec3& center, const Vec3& normal, double radius,
                                 double inner_radius = 0, const Mat4& transform = Mat4(1.0));
std::unique_ptr<Shape> make_paraboloid(const Vec3& tip, const Vec3& to, double radius, bool open = false,
                                       const Mat4& transform = Mat4(1.0));
std::unique_ptr<Shape> make_hyperboloid(const Vec3& from, const Vec3& to, double radius, double to_radius,
                                        double waist, bool open = false, const Mat4& transform = Mat4(1.0));
// True if there can be such a capsule.
bool fits_capsule(const Vec3& from, const Vec3& to, double radius, const Mat4& transform = Mat4(1.0));
std::unique_ptr<Shape> make_capsule(const Vec3& from, const Vec3& to, double radius,
                                    const Mat4& transform = Mat4(1.0), std::optional<double> to_radius = {});

// A x² + B y² + C z² + D xy + E xz + F yz + G x + H y + J z + K.
struct QuadricValues {
  Vec3 square;      // A, B, C
  Vec3 product;     // D, E, F
  Vec3 linear;      // G, H, J
  double constant;  // K
};
std::unique_ptr<Shape> make_quadric(const QuadricValues& values, const Vec3& min, const Vec3& max,
                                    bool open = false, const Mat4& transform = Mat4(1.0));

// Without `u_axis`, the default of planes.
std::unique_ptr<Shape> make_polygon(const PlanarRegion& region, const Mat4& transform = Mat4(1.0),
                                    const std::optional<Vec3>& u_axis = {});
std::unique_ptr<Shape> make_parallelogram(const Vec3& origin, const Vec3& edge_u, const Vec3& edge_v,
                                          const Mat4& transform = Mat4(1.0));
// uv of the caps are distances from `origin`, else from the first vertex. `holes` may be any outlines that do
// not cross: those within an odd number of others are holes.
std::unique_ptr<Shape> make_prism(const PlanarRegion& region, const Vec3& extrusion,
                                  const Mat4& transform = Mat4(1.0), const std::optional<Vec3>& origin = {});
std::unique_ptr<Shape> make_torus(const Vec3& center, const Vec3& axis, double major_radius,
                                  double minor_radius, const Mat4& transform = Mat4(1.0));
// e and n: 0.1 to 2.
std::unique_ptr<Shape> make_superellipsoid(const Vec3& center, const Vec3& radii, double e, double n,
                                           const Mat4& transform = Mat4(1.0));
// Rows of four control points.
std::unique_ptr<Shape> make_bezier(const std::array<Vec3, 16>& net, const Mat4& transform = Mat4(1.0));
// The corners, in order around the patch.
std::unique_ptr<Shape> make_bilinear(const std::array<Vec3, 4>& corners, const Mat4& transform = Mat4(1.0));

// The points with f ≤ 0 within a box of the shape's own space; if `open`, without the box's faces.
std::unique_ptr<Shape> make_implicit(FormulaUse use, bool open, const Mat4& transform = Mat4(1.0));

// The points within any of `operands` (if `all`: within all of them) and within none of `removed`. All shapes
// are closed, at most 32 together, and have their materials.
std::unique_ptr<Shape> make_csg(bool all, std::vector<std::unique_ptr<Shape>> operands,
                                std::vector<std::unique_ptr<Shape>> removed = {});

// Spheres of one radius, in the cloud's own units, around its points. Null if `transform` is no similarity,
// or if the spheres are out of range there.
std::unique_ptr<Shape> make_points(std::shared_ptr<const PointCloud> cloud, double radius,
                                   const Mat4& transform = Mat4(1.0));

}  // namespace eyeray::engine::shapes
