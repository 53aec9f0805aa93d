#include "host/scene/group.hpp"

#include "host/scene/affine.hpp"

namespace eyeray::engine {

Bounds bounds(const Group& group, const std::vector<Mesh>& meshes) {
  Bounds all;
  for (const auto& shape : group.shapes) {
    const Bounds box = shape->bounds();
    all.include(box.min);
    all.include(box.max);
  }
  for (const Instance& instance : group.instances) {
    const Affine map(instance.transform);
    for (const Vec3& position : meshes[size_t(instance.mesh)].positions) all.include(map.point(position));
  }
  return all;
}

uint64_t count_triangles(const Group& group, const std::vector<Mesh>& meshes) {
  uint64_t count = 0;
  for (const Instance& instance : group.instances) count += meshes[size_t(instance.mesh)].triangles.size();
  return count;
}

uint64_t count_primitives(const Group& group, const std::vector<Mesh>& meshes) {
  return group.shapes.size() + count_triangles(group, meshes);
}

}  // namespace eyeray::engine
