// Finds the hit of a ray with the scene: with a shape, or with a triangle of an instance, either of which may
// be in a group.
#pragma once

#include <deque>
#include <memory>

#include "host/core/pixel.hpp"
#include "host/reference/group_geometry.hpp"
#include "host/scene/light_choice.hpp"
#include "host/scene/photons.hpp"
#include "host/scene/primitive_ids.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::reference {

class PhotonMap;  // photon_map.hpp
class PhotonMaps;

struct Hit {
  TriangleHit at;      // for a shape: its intersection
  size_t object;       // index in its group or in the world, as in Objects::Hit
  uint64_t primitive;  // see scene/primitive_ids.hpp
  int material;        // index in Scene::materials
  int group = -1;      // index in Scene::group_instances; −1 for the scene's own
};

// A scene made ready for rays. Hits are the same to the last bit with every Acceleration (bvh.hpp has the
// proof).
class Tracer {
 public:
  // `scene` must outlive it. Under Acceleration::bvh, it takes a second or less for a million triangles.
  explicit Tracer(const Scene& scene, Acceleration acceleration = Acceleration::bvh);
  ~Tracer();

  // The nearest hit with t > 0; if several have exactly the same t, the one of the lowest primitive. Adds the
  // result's possible faults to `flags`, as SampleFlags. `coincident`: prefers the hit of another primitive
  // that is so close behind the nearest that float32 may take it for the nearer one. For this the ray's
  // direction must be unit.
  std::optional<Hit> trace(const Ray& ray, uint32_t& flags, bool coincident = false) const;
  std::optional<Hit> trace(const Ray& ray) const;
  // The surface at a hit of `ray`. Its normal is on the side of the geometric one, and is bent by the
  // material.
  SurfacePoint surface(const Ray& ray, const Hit& hit) const;

  // The largest coordinate, relative to `eye`, in any computation of the hit primitive; 0 for unbounded
  // shapes.
  double reach(const Hit& hit, const Vec3& eye) const;
  // FirstHit::t_scale of a hit. `surface`: the surface at that hit.
  double t_scale(const Ray& ray, const Hit& hit, const SurfacePoint& surface) const;

  // The share of light that comes through all objects that the ray hits at 0 < t < t_end. Adds to `flags`
  // like trace().
  double transmittance(const Ray& ray, double t_end, uint32_t& flags) const;

  const Scene& scene() const { return scene_; }
  // The scene's choice of lights if its integrator chooses one light; else empty.
  const LightChoice& light_choice() const { return light_choice_; }
  // True if paths of the scene may cross an interface (scene/interfaces.hpp).
  bool any_interface() const { return any_interface_; }
  // The photon map of sample `index`, if the scene's integrator emits photons. May be called from many
  // threads at once.
  std::shared_ptr<const PhotonMap> photons(uint32_t index) const;
  // From now on these photons of each sample contribute nothing.
  void leave_out(LeftOutPhotons photons) const;
  // The scene's own objects, and its group instances in the order of Scene::group_instances.
  const Objects& world() const { return *world_; }
  const std::vector<GroupGeometry>& groups() const { return groups_; }
  // The ray, prepared for the intersection with the boxes of groups().
  BoxRay group_box_ray(const Ray& ray) const;

 private:
  std::optional<Hit> coincident_with(const Ray& ray, const Hit& hit) const;
  void search_groups(const Ray& ray, std::optional<Hit>& nearest, double& sure_until) const;
  uint64_t primitive(const Objects& objects, const Objects::Hit& hit, int group) const;
  Hit complete(const Objects& objects, const Objects::Hit& hit, int group) const;

  const Scene& scene_;
  const bool any_interface_;
  PrimitiveIds ids_;
  std::deque<MeshGeometry> meshes_;  // in the order of Scene::meshes; a deque, since instances point into it
  std::optional<Objects> world_;
  std::deque<Objects> group_bodies_;  // the objects of each group, in the order of Scene::groups
  std::vector<GroupGeometry> groups_;
  double groups_reach_ = 0;   // the largest coordinate in any computation that yields a group's box
  double groups_growth_ = 1;  // the largest growth() of all groups
  BoxBvh group_bvh_;          // BVH over the boxes of groups_
  LightChoice light_choice_;
  std::unique_ptr<PhotonMaps> photon_maps_;
};

}  // namespace eyeray::engine::reference
