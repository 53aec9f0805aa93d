// The interface of every shape, in float64. A shape is one .cpp in host/shapes (manual page, parse, bounds,
// float64 intersection, pack), one .glsl in shaders/shapes, one scene in scenes/shapes and one row in
// shapes/rows.h.
#pragma once

#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/core/vec.hpp"
#include "host/scene/bounds.hpp"
#include "host/scene/names.hpp"

namespace eyeray::engine {

namespace formula {
class Formula;  // formula/formula.hpp
}
namespace records {
class Packer;  // records/packer.hpp
}

// A ray's hit of a shape: at P(t), with the shape's own two parameters there (barycentrics of a triangle,
// …).
struct Intersection {
  double t = 0;
  double u = 0;
  double v = 0;
  uint32_t part = 0;             // part of a CSG object: the part whose surface is hit
  bool iteration_limit = false;  // no hit up to t; beyond t the allowed steps did not suffice
};

// A stretch of a ray's line, from where it enters a closed shape to where it leaves it.
struct Span {
  Intersection in, out;
};

// The surface at an intersection, world space.
struct SurfacePoint {
  Vec3 position;          // projected onto the surface
  double position_error;  // a bound on its distance from the true surface, in float64 arithmetic
  Vec3 normal_geometric;  // unit; outward for closed shapes, by counter-clockwise winding for open ones
  Vec3 normal;            // unit shading normal; ignored on the other side than normal_geometric
  Vec2 uv;
  // The derivatives of the position by u and by v; 0 for a surface without uv.
  Vec3 along_u{0.0}, along_v{0.0};
  // As Mesh::tangents, but not unit; w = 0 for a surface that is no mesh with tangents.
  Vec4 tangent{0.0};
  // uv, derivatives and tangent by a mesh's second texture coordinates, which images may read.
  struct SecondUv {
    Vec2 uv;
    Vec3 along_u, along_v;
    Vec4 tangent;
  };
  std::optional<SecondUv> second = {};
  Vec3 color{1.0};        // color of a mesh's vertices
  Vec3 coat_normal{0.0};  // unit normal of a clear coat, like `normal`, once the material has set it
  Vec3 rough_axis{
      0.0};  // unit, along the surface (RoughAxis), once the material has set it; 0 if there is none
  // The distance by which a triangle with normals at its corners lifts its scattered rays along its
  // interpolated normal, in front and behind (docs/numerics.md); −1 for any other surface.
  Vec2 lift{-1.0};
  // A triangle's edges, from each corner to the next, and the weights of its corners; 0 for any other
  // surface.
  std::array<Vec3, 3> edges{};
  Vec3 weights{0.0};
  // Unit; decides on which side of the surface a direction is, once the surface is in the world. It is the
  // interpolated normal where rays are lifted, else normal_geometric.
  Vec3 normal_side{0.0};
};

// Turns the normals, and the vectors that belong to them, to the other side.
inline void turn_over(SurfacePoint& point) {
  for (Vec3* normal : {&point.normal_geometric, &point.normal, &point.coat_normal, &point.normal_side})
    *normal = -*normal;
  std::swap(point.lift.x, point.lift.y);
}

// Sets along_u and along_v of a surface perpendicular to normal_geometric, from the gradients of u and v
// along the surface.
inline void set_along(SurfacePoint& point, const Vec3& u_gradient, const Vec3& v_gradient) {
  const double area = glm::dot(point.normal_geometric, glm::cross(u_gradient, v_gradient));
  point.along_u = glm::cross(v_gradient, point.normal_geometric) / area;
  point.along_v = glm::cross(point.normal_geometric, u_gradient) / area;
}

// Clamps uv of a surface that is 1 wide in them, so that rounding does not move a point of the border to
// where a texture's next check begins.
inline Vec2 inner_uv(const Vec2& uv) {
  return glm::clamp(uv, 0.0, 1 - 0x1p-53);
}

// A shape in the terms that other renderers share.
struct SphereForm {
  Vec3 center;
  double radius;
  glm::dmat3 axes{1.0};  // its own x, y (the pole), z: orthonormal, left-handed under a mirror
};
struct PlaneForm {
  Vec3 point;
  Vec3 normal;  // unit
};
struct TriangleForm {
  std::array<Vec3, 3> vertices;
};
// The other forms are in object space, which `to_world` maps.
struct BoxForm {  // the cube from −1 to 1
  Mat4 to_world;
};
struct DiskForm {  // y = 0, inner ≤ the distance from the origin ≤ 1
  Mat4 to_world;
  double inner;
};
// Balls around the points of the y axis at −half and half, and the cone that touches both.
struct CapsuleForm {
  Mat4 to_world;
  double half;
  double low, high;  // the balls' radii; the larger is 1
};
// square · (x², y², z²) + product · (xy, xz, yz) + linear · (x, y, z) + constant ≤ 0 within `clip`. If
// `open`, only the surface, without the faces of `clip`.
struct QuadricForm {
  Mat4 to_world;
  Vec3 square, product, linear;
  double constant;
  Bounds clip;
  bool open;
};
struct TorusForm {  // within `minor` of the unit circle in y = 0
  Mat4 to_world;
  double minor;
};
struct SuperellipsoidForm {  // (|x|^(2/e) + |z|^(2/e))^(e/n) + |y|^(2/n) ≤ 1
  Mat4 to_world;
  double e, n;
};
// Outlines: around the shape, then around each hole.
struct PolygonForm {  // in the world
  std::vector<std::vector<Vec3>> outlines;
};
struct ExtrusionForm {  // outlines in (x, z), extruded from y = −1 to 1
  Mat4 to_world;
  std::vector<std::vector<Vec2>> outlines;
};
struct BezierForm {  // rows of four control points
  std::array<Vec3, 16> net;
};
class Shape;
// The points within any of `operands`, or if `all` within all of them, and within none of `removed`.
struct CsgForm {
  bool all;
  std::vector<const Shape*> operands;
  std::vector<const Shape*> removed;
};
using ShapeForm =
    std::variant<std::monostate, SphereForm, PlaneForm, TriangleForm, BoxForm, DiskForm, CapsuleForm,
                 QuadricForm, TorusForm, SuperellipsoidForm, PolygonForm, ExtrusionForm, BezierForm, CsgForm>;

// A formula that bounds a shape within a box of object space: negative inside the shape, or on one side of an
// open surface.
struct FormulaUse {
  std::shared_ptr<const formula::Formula> formula;
  Bounds box;
  double lipschitz;       // the stated bound of its steepness; 0 if none is stated
  bool declared = false;  // by the user, who may be wrong
};

class Shape {
 public:
  virtual ~Shape() = default;

  // The nearest intersection with t > 0, if there is one. A result with `iteration_limit` need not be an
  // intersection.
  virtual std::optional<Intersection> intersect(const Ray& ray) const = 0;
  virtual SurfacePoint surface(const Ray& ray, const Intersection& hit) const = 0;
  virtual Bounds bounds() const = 0;
  // The shape whose surface and material are hit: this one, or a part of a CSG object.
  virtual const Shape& part(const Intersection&) const { return *this; }
  // True if the shape encloses a volume, so that CSG objects can be made of it.
  virtual bool is_closed() const { return false; }
  // The spans of the ray's whole line, t < 0 included, that lie within a closed shape: in order, none touches
  // another. Beyond an end that is `iteration_limit` no span is known.
  virtual std::vector<Span> spans(const Ray&) const { return {}; }
  // The shape's form, for exporters and for comparing with other renderers; monostate for shapes that they
  // lack.
  virtual ShapeForm form() const { return {}; }
  // The formula of a shape that is made of one; else null.
  virtual const FormulaUse* formula_use() const { return nullptr; }
  // True if each crossing of the shape weakens a shadow ray by √(the material's share), as a mesh's triangles
  // do. That holds for open shapes that may be part of a closed surface. Other shapes weaken a ray once in
  // all.
  virtual bool counts_crossings() const { return false; }
  // The shape's thickness, as a multiple of the least thickness that can be computed for its kind. Infinity
  // if no map can make the shape too thin.
  virtual double thickness_margin() const { return std::numeric_limits<double>::infinity(); }
  // The largest number of times that a line crosses the shape, as far as it is known. Rounding may add
  // crossings.
  virtual int most_crossings() const { return 1 << 20; }
  // Appends the shape's one Primitive (and the data it refers to), or several, each with its bounds.
  virtual void pack(records::Packer& packer) const = 0;

  int material = 0;                 // index in Scene::materials
  std::string_view type = "shape";  // the name of its table in a scene file; "shape" if no file made it
  NameRef name;                     // in Scene::names
  SourcePosition position;          // position of its table in the scene file
};

// Calls visit(leaf) for each shape that a CSG object and the CSG objects in it are made of, in the order of
// its table. For any other shape, calls visit once, with that shape.
template <typename Visit>
void for_each_leaf(const Shape& shape, const Visit& visit) {
  const ShapeForm form = shape.form();
  const auto* csg = std::get_if<CsgForm>(&form);
  if (!csg) return visit(shape);
  for (const auto* list : {&csg->operands, &csg->removed})
    for (const Shape* each : *list) for_each_leaf(*each, visit);
}

}  // namespace eyeray::engine
