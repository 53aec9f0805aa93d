#include "host/scene/primitive_ids.hpp"

#include <algorithm>
#include <span>

#include "host/scene/scene.hpp"

namespace eyeray::engine {

PrimitiveIds::PrimitiveIds(const Scene& scene) {
  // Number the shapes: the scene's own, and between them those of groups.
  uint64_t grouped = 0;
  for (const GroupInstance& instance : scene.group_instances) {
    groups_.push_back({instance.shapes_before + grouped, 0});
    shapes_before_.push_back(instance.shapes_before);
    group_shapes_.push_back(grouped);
    grouped += scene.groups[size_t(instance.group)].shapes.size();
  }
  group_shapes_.push_back(grouped);
  count_ = shape_count_ = scene.shapes.size() + grouped;

  // Number the triangles: those of the scene's own instances, and between them those of groups.
  std::vector<uint64_t> triangles;
  for (const Group& group : scene.groups) triangles.push_back(count_triangles(group, scene.meshes));
  size_t next = 0;
  const auto place_groups = [&](size_t before) {
    for (; next < groups_.size() && scene.group_instances[next].instances_before <= before; ++next) {
      groups_[next].triangle = count_;
      count_ += triangles[size_t(scene.group_instances[next].group)];
    }
  };
  for (size_t i = 0; i < scene.instances.size(); ++i) {
    place_groups(i);
    instances_.push_back(count_);
    count_ += scene.meshes[size_t(scene.instances[i].mesh)].triangles.size();
  }
  place_groups(scene.instances.size());
}

uint64_t PrimitiveIds::of_shape(size_t shape) const {
  const auto after = std::upper_bound(shapes_before_.begin(), shapes_before_.end(), shape);
  return shape + group_shapes_[size_t(after - shapes_before_.begin())];
}

PrimitiveIds::Location PrimitiveIds::locate(uint64_t primitive, const Scene& scene) const {
  // Find the last group instance that begins at `primitive` or before. The one after an empty instance begins
  // at the same index.
  const bool is_shape = primitive < shape_count_;
  const auto first = [&](const First& group) { return is_shape ? group.shape : group.triangle; };
  const auto after = std::ranges::upper_bound(groups_, primitive, {}, first);
  Location location{.is_shape = is_shape};
  std::span<const Instance> instances = scene.instances;
  uint64_t rest = primitive;
  if (after != groups_.begin()) {
    const auto group = size_t(std::prev(after) - groups_.begin());
    const Group& content = scene.groups[size_t(scene.group_instances[group].group)];
    const uint64_t size = is_shape ? content.shapes.size() : count_triangles(content, scene.meshes);
    if (primitive - first(groups_[group]) < size) {
      location.group_instance = int(group);
      rest = primitive - first(groups_[group]);
      instances = content.instances;
    }
  }
  if (is_shape) {
    const auto groups_before = size_t(after - groups_.begin());
    location.index = location.group_instance >= 0 ? rest : rest - group_shapes_[groups_before];
    return location;
  }
  if (location.group_instance < 0) {
    const auto next = std::ranges::upper_bound(instances_, primitive);
    location.index = size_t(next - instances_.begin()) - 1;
    location.triangle = size_t(primitive - instances_[location.index]);
    return location;
  }
  for (const Instance& instance : instances) {
    const size_t triangles = scene.meshes[size_t(instance.mesh)].triangles.size();
    if (rest < triangles) break;
    rest -= triangles;
    ++location.index;
  }
  location.triangle = size_t(rest);
  return location;
}

}  // namespace eyeray::engine
