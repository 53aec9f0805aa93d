#include "scene/scene.hpp"

namespace eyeray {

uint64_t Scene::primitive_count() const {
  uint64_t count = shapes.size();
  for (const Instance& instance : instances) count += meshes[size_t(instance.mesh)].triangles.size();
  return count;
}

}  // namespace eyeray
