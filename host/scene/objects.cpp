#include "host/scene/objects.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace eyeray::engine {

Objects::Objects(const Scene& scene) : scene_(scene), ids_(scene) {
  first_in_group_.push_back(scene.shapes.size() + scene.instances.size());
  for (const GroupInstance& instance : scene.group_instances) {
    const Group& group = scene.groups[size_t(instance.group)];
    first_in_group_.push_back(first_in_group_.back() + group.shapes.size() + group.instances.size());
  }
}

Object Objects::operator[](size_t index) const {
  // Find the group that it is in, if any.
  const auto after = std::ranges::upper_bound(first_in_group_, index);
  const bool grouped = after != first_in_group_.begin();
  const size_t group = grouped ? size_t(after - first_in_group_.begin()) - 1 : 0;
  const size_t member = grouped ? index - first_in_group_[group] : index;
  const GroupInstance* shown = grouped ? &scene_.group_instances[group] : nullptr;
  const auto& shapes = grouped ? scene_.groups[size_t(shown->group)].shapes : scene_.shapes;
  const auto& instances = grouped ? scene_.groups[size_t(shown->group)].instances : scene_.instances;
  const NameRef group_name = grouped ? shown->name : NameRef{};

  if (member < shapes.size()) {
    const Shape& shape = *shapes[member];
    const uint64_t id = grouped ? ids_.of_group(group).shape + member : ids_.of_shape(member);
    return {shape.type, shape.name, group_name, "", &shape.position, shape.material, id, 1};
  }
  const size_t i = member - shapes.size();
  const Instance& instance = instances[i];
  const auto triangles = [&](const Instance& of) { return scene_.meshes[size_t(of.mesh)].triangles.size(); };
  uint64_t first = grouped ? ids_.of_group(group).triangle : ids_.of_instance(i);
  for (size_t k = 0; grouped && k < i; ++k) first += triangles(instances[k]);
  return {"mesh",
          instance.name,
          group_name,
          scene_.meshes[size_t(instance.mesh)].name,
          &instance.position,
          instance.material,
          first,
          triangles(instance)};
}

size_t Objects::of(uint64_t primitive) const {
  const PrimitiveIds::Location at = ids_.locate(primitive, scene_);
  const bool grouped = at.group_instance >= 0;
  const size_t first = grouped ? first_in_group_[size_t(at.group_instance)] : 0;
  if (at.is_shape) return first + at.index;
  const auto& shapes =
      grouped ? scene_.groups[size_t(scene_.group_instances[size_t(at.group_instance)].group)].shapes
              : scene_.shapes;
  return first + shapes.size() + at.index;
}

std::string Objects::describe(uint64_t primitive) const {
  const Object object = (*this)[of(primitive)];
  std::string text = object.kind == "mesh" ? fmt::format("triangle {} of ", primitive - object.first) : "";
  text += eyeray::engine::describe(object, scene_.names);
  if (path(object, scene_.names).empty() && !object.mesh.empty()) text += fmt::format(" \"{}\"", object.mesh);
  if (object.position->line > 0) text += fmt::format(", {}:{}", object.position->file, object.position->line);
  return text;
}

std::string path(const Object& object, const Names& names) {
  const std::string group = names.path(object.group.index);
  const std::string own = names.path(object.name.index);
  return group + (group.empty() || own.empty() ? "" : "/") + own;
}

std::string describe(const Object& object, const Names& names) {
  const std::string name = path(object, names);
  if (name.empty()) return std::string(object.kind);
  return fmt::format("{} {}\"{}\"", object.kind, object.name.own ? "" : "in ", name);
}

}  // namespace eyeray::engine
