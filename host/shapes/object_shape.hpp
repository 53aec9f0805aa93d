// Common parts of shapes that are the image, under any affine map, of a simple shape in object space, such as
// the unit sphere. In the shaders it is geometry/object_space.glsl.
#pragma once

#include <vector>

#include "host/records/records.hpp"
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
  // Adds the data of the shape's primitive to the packer, and returns the primitive: for shapes that consist
  // of several such.
  shader::Primitive record(records::Packer& packer, int of_material) const;

 protected:
  // The hits of a line with the shape, in any order. The meaning of their u and v depends on the shape.
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
  // the maps. `steps` is the limit on the iterations of the shape's loops there, after which they give up
  // (T_ITERATION_LIMIT).
  ObjectShape(uint32_t kind, const Mat4& to_world, const std::vector<float>& parameters = {},
              size_t steps = 0);

  const Affine& to_world() const { return to_world_; }
  // Packs the shape with parameters that only the packer knows.
  void pack_with(records::Packer& packer, const std::vector<float>& parameters) const;

 private:
  shader::Primitive record_with(records::Packer& packer, int of_material,
                                const std::vector<float>& parameters) const;
  // The arguments and results are in object space. The ray starts near the shape; its t may be negative.
  virtual Crossings crossings(const Ray& ray) const = 0;
  // The nearest crossing beyond t = `from`.
  virtual std::optional<Intersection> first(const Ray& ray, double from) const;
  // True if the ray enters at that crossing, by the gradient there.
  virtual bool enters(const Ray& ray, const Intersection& crossing) const;
  virtual Point point(const Vec3& near, const Intersection& hit) const = 0;
  virtual Bounds extent() const = 0;

  // The ray in object space, restarted at its point nearest to the centre, and the t of that point. So
  // nothing cancels, however far away the ray's own start is.
  std::pair<Ray, double> to_nearest(const Ray& ray) const;

  uint32_t kind_;
  Affine to_world_;
  Affine to_object_;
  std::vector<float> parameters_;
  size_t steps_;
};

// The map that takes y = low … high on the y axis of object space to the segment from `from` to `to`. It
// takes the other two unit vectors to vectors of the length `radius`, perpendicular to the segment. The image
// of x, where u = ½, is as near to the world's +x as can be; if the segment is parallel to +x, to +z.
Mat4 along_axis(const Vec3& from, const Vec3& to, double radius, double low, double high);

// The reason why the shape is too large, small, thin or far away to be computed with under this map to the
// world, or "".
std::string why_out_of_range(const Mat4& to_world);
// Reports that reason at `transform`. Returns whether there is one.
bool out_of_range(TableReader& table, const Mat4& to_world);

// The derivative by u of a point that rotates about the y axis.
Vec3 along_turn(const Vec3& position);

// The derivative by v of the unit vector whose angle from −y is v half turns.
Vec3 along_meridian(const Vec3& direction);

// The real roots of a·t² + 2b·t + c = 0, without cancellation; none where all of a, b and c are 0.
std::vector<double> quadratic_roots(double a, double b, double c);

}  // namespace eyeray::engine::shapes
