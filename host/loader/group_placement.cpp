#include "loader/group_placement.hpp"

#include "scene/affine.hpp"

namespace eyeray {

int GroupPlacer::keep(Group group) {
  Bounds& all = bounds_.emplace_back();
  for (const auto& shape : group.shapes) {
    const Bounds box = shape->bounds();
    all.include(box.min);
    all.include(box.max);
  }
  scene_.groups.push_back(std::move(group));
  return int(scene_.groups.size()) - 1;
}

std::string GroupPlacer::place(int index, const Mat4& transform, const SourcePosition& position,
                               const NameRef& name) {
  const Group& group = scene_.groups[size_t(index)];
  if (!group.shapes.empty()) {
    const Affine map(transform);
    const auto& [low, high] = bounds_[size_t(index)];
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p(corner & 1 ? low.x : high.x, corner & 2 ? low.y : high.y, corner & 4 ? low.z : high.z);
      if (!(magnitude(map.point(p)) <= max_coordinate))
        return "the transformed shapes are out of range (coordinates up to 1e12)";
    }
  }
  for (const Instance& instance : group.instances) {
    std::string wrong = meshes_.check(size_t(instance.mesh), transform * instance.transform);
    if (!wrong.empty()) return wrong;
  }
  scene_.group_instances.push_back(
      {index, transform, scene_.shapes.size(), scene_.instances.size(), position, name});
  return "";
}

}  // namespace eyeray
