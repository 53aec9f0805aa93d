#include "host/loader/group_placement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/scene/affine.hpp"

namespace eyeray::engine::loader {

int GroupPlacer::keep(Group group, double stretch) {
  Extent extent{{}, std::numeric_limits<double>::infinity(), stretch};
  for (const auto& shape : group.shapes) {
    const Bounds box = shape->bounds();
    extent.bounds.include(box.min);
    extent.bounds.include(box.max);
    extent.thickness = std::min(extent.thickness, shape->thickness_margin());
  }
  extents_.push_back(extent);
  scene_.groups.push_back(std::move(group));
  return int(scene_.groups.size()) - 1;
}

bool GroupPlacer::surely_fits(int index, const Mat4& transform) const {
  const Group& group = scene_.groups[size_t(index)];
  const Extent& extent = extents_[size_t(index)];
  const Affine map(transform);
  if (extent.condition * condition(map.linear) > worst_condition) return false;
  if (!group.shapes.empty()) {
    const auto& [low, high] = extent.bounds;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p(corner & 1 ? low.x : high.x, corner & 2 ? low.y : high.y, corner & 4 ? low.z : high.z);
      if (!(magnitude(map.point(p)) <= max_coordinate)) return false;
    }
  }

  // Leave a margin: a rotation alone changes some measures of thickness by up to three times.
  constexpr double turn = 10;
  if (extent.thickness * thinning(map.linear) < turn) return false;
  return std::ranges::all_of(group.instances, [&](const Instance& instance) {
    return meshes_.check(size_t(instance.mesh), transform * instance.transform).empty();
  });
}

void GroupPlacer::place(int index, const Mat4& transform, const SourcePosition& position,
                        const NameRef& name) {
  scene_.group_instances.push_back(
      {index, transform, scene_.shapes.size(), scene_.instances.size(), position, name});
}

}  // namespace eyeray::engine::loader
