// A group instance in the world: the hits of rays with it, and the surfaces there.
#pragma once

#include "host/reference/objects.hpp"

namespace eyeray::engine::reference {

class GroupGeometry {
 public:
  // `objects`: the group's objects, which must outlive this instance. `before`: PrimitiveIds::of_group() of
  // this instance.
  GroupGeometry(const GroupInstance& instance, const Objects& objects, const PrimitiveIds::First& before)
      : objects_(&objects), map_(instance.transform), box_(map_.bounds(objects.bounds())), before_(before) {}

  const Objects& objects() const { return *objects_; }
  // A box in the world around the group's own box.
  const Bounds& bounds() const { return box_; }
  double reach() const { return map_.reach(objects_->bounds()); }
  double growth() const { return map_.growth() * objects_->growth(); }

  // The nearest hit of the group's objects, for rays in world space. t is the same in both spaces.
  std::optional<Objects::Hit> trace(const Ray& ray, double limit, double& sure_until) const {
    return objects_->trace(map_.into(ray), limit, sure_until, before_);
  }
  std::optional<Objects::Hit> intersect(size_t object, const Ray& ray) const {
    return objects_->intersect(object, map_.into(ray));
  }
  SurfacePoint surface(const Ray& ray, const Objects::Hit& hit) const {
    return map_.out(objects_->surface(map_.into(ray), hit));
  }
  bool add_shares(const Ray& ray, double t_end, size_t space, std::vector<Objects::Share>& shares,
                  bool& gave_up) const {
    return objects_->add_shares(map_.into(ray), t_end, space, shares, gave_up, before_);
  }
  double reach(const Objects::Hit& hit, const Vec3& eye) const {
    const double in_group = objects_->reach(hit, Vec3(0));
    return map_.reach({Vec3(-in_group), Vec3(in_group)}, eye);
  }

 private:
  const Objects* objects_;
  InstanceMap map_;
  Bounds box_;
  PrimitiveIds::First before_;
};

}  // namespace eyeray::engine::reference
