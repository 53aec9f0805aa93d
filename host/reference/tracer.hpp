// What a ray meets: a shape, or a triangle of an instance.
#pragma once

#include <cmath>
#include <deque>

#include "core/pixel.hpp"
#include "reference/instance_geometry.hpp"
#include "scene/scene.hpp"

namespace eyeray::reference {

struct Hit {
  TriangleHit at;      // of a shape: its intersection
  size_t body;         // a shape, by its index in Scene::shapes; the instances follow
  uint64_t primitive;  // see Scene::primitive_count
  int material;        // index in Scene::materials
};

// A scene made ready for rays. Hits are the same to the last bit with every Acceleration (box_tree.hpp says
// why).
class Tracer {
 public:
  // `scene` must outlive it. Under Acceleration::tree, a second for a million triangles or less.
  explicit Tracer(const Scene& scene, Acceleration acceleration = Acceleration::tree);

  // The nearest hit with t > 0; of exactly equal ones that of the lowest primitive. Adds to `flags`, of
  // SampleFlags, what may be wrong with it.
  std::optional<Hit> trace(const Ray& ray, uint32_t& flags) const;
  std::optional<Hit> trace(const Ray& ray) const;
  // The surface where `ray` has that hit.
  SurfacePoint surface(const Ray& ray, const Hit& hit) const;

  // The largest coordinate, relative to `eye`, of the terms that what was hit is made of; 0 for unbounded
  // shapes.
  double reach(const Hit& hit, const Vec3& eye) const;

  // The share of light that comes through all that the ray meets at 0 < t < t_end. A shape counts once; of an
  // instance each triangle lets the square root of its material's share through, so that a closed mesh, which
  // is crossed twice, counts once as well. `flags` as for trace.
  double transmittance(const Ray& ray, double t_end, uint32_t& flags) const;

  const Scene& scene() const { return scene_; }
  // As Scene::instances.
  const std::vector<InstanceGeometry>& instances() const { return instances_; }

 private:
  // Of a shape, or of its part that has the surface there.
  int material(size_t body, const Intersection& hit) const;
  std::optional<Intersection> intersect_shape(size_t shape, const Ray& ray) const;
  std::optional<TriangleHit> intersect(size_t body, const Ray& ray, double limit) const;
  double share_let_through(size_t body, const Ray& ray, double entry, double t_end, bool& gave_up) const;
  template <typename Visit>
  void for_each_entered(const Ray& ray, double limit, const Visit& visit) const;

  const Scene& scene_;
  std::deque<MeshGeometry> meshes_;  // as Scene::meshes; a deque, since instances point into it
  std::vector<InstanceGeometry> instances_;
  std::vector<uint64_t> first_primitives_;  // of each instance
  std::vector<uint32_t> unbounded_;         // bodies
  std::vector<uint32_t> bounded_;           // bodies, …
  std::vector<Bounds> boxes_;               // … and where they are
  double reach_ = 0;                        // the largest coordinate in any computation that yields a box
  double growth_ = 1;                       // the largest of all instances
  BoxTree tree_;                            // of boxes_
};

// Where a ray into direction `d` leaves from a surface point: off the surface by a few error bounds, and by
// `least`, on the side of `d`, so that the ray does not meet the surface that it leaves. As the shaders do
// (ray.glsl), it stays on its line where that is steep: near an edge it then starts beyond the same other
// face.
// With `along_normal` it never does.
Vec3 departure(const SurfacePoint& point, const Vec3& d, double least = 0, bool along_normal = false);

// Many more than the surfaces of a mesh that a ray can sensibly cross.
inline constexpr int most_crossings = 1 << 20;

// Calls visit(t, hit, surface) for each crossing of the body, a Shape or an InstanceGeometry, in order of t,
// until `visit` returns false. It ends after the body's most_crossings(), else most_crossings, and where
// rounding lets a ray come no further. Returns up to which t none is left out for want of steps, infinity for
// all.
template <typename Body, typename Visit>
double for_each_crossing(const Body& body, const Ray& ray, const Visit& visit) {
  int most = most_crossings;
  if constexpr (requires { body.most_crossings(); }) most = body.most_crossings();
  // Start anew behind each crossing; t stays that of the ray as given.
  Ray rest = ray;
  double passed = 0;
  for (int crossings = 0; crossings < most; ++crossings) {
    const auto hit = body.intersect(rest);
    if (!hit) break;
    if (hit->ran_out) return passed + hit->t;
    const SurfacePoint surface = body.surface(rest, *hit);
    if (!visit(passed + hit->t, *hit, surface)) break;
    rest.o = departure(surface, ray.d);
    const double before = passed;
    passed = glm::dot(rest.o - ray.o, ray.d) / glm::dot(ray.d, ray.d);
    if (!(passed > before)) break;
  }
  return HUGE_VAL;
}

}  // namespace eyeray::reference
