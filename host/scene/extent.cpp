#include "host/scene/extent.hpp"

#include <cmath>

#include "host/scene/affine.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine {

bool is_finite(const Bounds& box) {
  return std::isfinite(glm::length(box.max - box.min));
}

Bounds extent(const Scene& scene) {
  Bounds all;
  const auto include = [&](const Bounds& box, const Affine& map) {
    if (!is_finite(box)) return;
    for (int corner = 0; corner < 8; ++corner)
      all.include(map.point({(corner & 1 ? box.max : box.min).x, (corner & 2 ? box.max : box.min).y,
                             (corner & 4 ? box.max : box.min).z}));
  };
  for (const auto& shape : scene.shapes) include(shape->bounds(), Affine(Mat4(1.0)));
  for (const Instance& instance : scene.instances)
    include(bounds(scene.meshes[size_t(instance.mesh)]), Affine(instance.transform));
  for (const GroupInstance& instance : scene.group_instances)
    include(bounds(scene.groups[size_t(instance.group)], scene.meshes), Affine(instance.transform));
  return all;
}

}  // namespace eyeray::engine
