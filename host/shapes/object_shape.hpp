// Common parts of shapes that are a plain one, such as the unit sphere, in object space under any affine map.
// In the shaders it is geometry/object_space.glsl.
#pragma once

#include <vector>

#include "host/scene/affine.hpp"
#include "host/scene/shape.hpp"
#include "host/shapes/registry.hpp"

namespace eyeray::engine::shapes {

class ObjectShape : public Shape {
 public:
  std::optional<Intersection> intersect(const Ray& ray) const final;
  SurfacePoint surface(const Ray& ray, const Intersection& hit) const final;
  std::vector<Span> spans(const Ray& ray) const final;
  Bounds bounds() const override;
  void pack(records::Packer& packer) const override;

 protected:
  // The hits of a line with the shape, in any order. u and v are the shape's own.
  class Crossings {
   public:
    void add(const Intersection& crossing) { all_.push_back(crossing); }
    auto begin() const { return all_.begin(); }
    auto end() const { return all_.end(); }

   private:
    std::vector<Intersection> all_;
  };
  struct Point {
    Vec3 position;  // on the shape
    Vec3 gradient;  // points outward, of any length but 0
    Vec2 uv;
    Vec3 along_u, along_v;  // derivatives of the position by u and v
  };

  // `kind` is the shape's number in the registry. `parameters` are the numbers that the shaders find after
  // the maps. `steps` is the limit on its loops' iterations there, after which it gives up
  // (T_ITERATION_LIMIT).
  ObjectShape(uint32_t kind, const Mat4& to_world, const std::vector<float>& parameters = {},
              size_t steps = 0);

  const Affine& to_world() const { return to_world_; }
  // Packs it with parameters that only the packer knows.
  void pack_with(records::Packer& packer, const std::vector<float>& parameters) const;

 private:
  // All in object space. The ray starts near the shape; its t may be negative.
  virtual Crossings crossings(const Ray& ray) const = 0;
  // The nearest of them beyond t = `from`.
  virtual std::optional<Intersection> first(const Ray& ray, double from) const;
  // True if the ray enters at that crossing, by the gradient there.
  virtual bool enters(const Ray& ray, const Intersection& crossing) const;
  virtual Point point(const Vec3& near, const Intersection& hit) const = 0;
  virtual Bounds extent() const = 0;

  // The ray in object space, from its point nearest to the centre, so that nothing cancels however far away
  // its own start is; and the t of that point.
  std::pair<Ray, double> to_nearest(const Ray& ray) const;

  uint32_t kind_;
  Affine to_world_;
  Affine to_object_;
  std::vector<float> parameters_;
  size_t steps_;
};

// The map under which y = low … high on the axis of object space comes to stand from `from` to `to`, and
// whose other two axes are `radius` long and perpendicular to it. The first of them, where u = ½, is as near
// to the world's +x as can be; if the axis is parallel to that, to +z.
Mat4 along_axis(const Vec3& from, const Vec3& to, double radius, double low, double high);

// Reports at `transform` if the shape is too large, small or far away to be computed with under this map to
// the world. Returns whether it is.
bool out_of_range(TableReader& table, const Mat4& to_world);

// The derivative by u of a point that rotates about the y axis.
Vec3 along_turn(const Vec3& position);

// The derivative by v of the unit vector whose angle from −y is v half turns.
Vec3 along_meridian(const Vec3& direction);

// The real roots of a·t² + 2b·t + c = 0, without cancellation; none where all of a, b and c are 0.
std::vector<double> quadratic_roots(double a, double b, double c);

}  // namespace eyeray::engine::shapes
