#include "host/scene/scene.hpp"

#include "host/scene/integrator.hpp"

namespace eyeray::engine {

bool fills(const Material& material, IntegratorType integrator) {
  return material.medium() && !(material.thin() && walks_at_random(integrator));
}

uint64_t Scene::primitive_count() const {
  uint64_t count = shapes.size();
  for (const Instance& instance : instances) count += meshes[size_t(instance.mesh)].triangles.size();
  std::vector<uint64_t> sizes;
  for (const Group& group : groups) sizes.push_back(count_primitives(group, meshes));
  for (const GroupInstance& instance : group_instances) count += sizes[size_t(instance.group)];
  return count;
}

}  // namespace eyeray::engine
