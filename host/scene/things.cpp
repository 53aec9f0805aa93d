#include "scene/things.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace eyeray {

Things::Things(const Scene& scene) : scene_(scene) {
  uint64_t end = scene.shapes.size();
  for (const Instance& instance : scene.instances) {
    end += scene.meshes[size_t(instance.mesh)].triangles.size();
    ends_.push_back(end);
  }
}

Thing Things::operator[](size_t index) const {
  const size_t shapes = scene_.shapes.size();
  if (index < shapes) {
    const Shape& shape = *scene_.shapes[index];
    return {
        shape.type ? shape.type->name : "shape", shape.name, "", &shape.position, shape.material, index, 1};
  }
  const size_t i = index - shapes;
  const Instance& instance = scene_.instances[i];
  const uint64_t first = i == 0 ? shapes : ends_[i - 1];
  const std::string& mesh = scene_.meshes[size_t(instance.mesh)].name;
  return {"mesh", instance.name, mesh, &instance.position, instance.material, first, ends_[i] - first};
}

size_t Things::of(uint64_t primitive) const {
  const size_t shapes = scene_.shapes.size();
  if (primitive < shapes) return primitive;
  return shapes + size_t(std::ranges::upper_bound(ends_, primitive) - ends_.begin());
}

std::string Things::describe(uint64_t primitive) const {
  const Thing thing = (*this)[of(primitive)];
  std::string text = thing.kind == "mesh" ? fmt::format("triangle {} of ", primitive - thing.first) : "";
  text += eyeray::describe(thing.kind, thing.name, scene_.names);
  if (thing.name.index == Names::none && !thing.mesh.empty()) text += fmt::format(" \"{}\"", thing.mesh);
  if (thing.position->line > 0) text += fmt::format(", {}:{}", thing.position->file, thing.position->line);
  return text;
}

}  // namespace eyeray
