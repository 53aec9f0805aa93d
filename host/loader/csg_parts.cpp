#include "host/loader/csg_parts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace eyeray::engine::loader {

std::string why_no_part(const Section& section) {
  switch (section.kind) {
    case Section::Kind::mesh:
      return "a mesh cannot be part of a CSG object, because nothing ensures that it encloses a volume";
    case Section::Kind::group:
    case Section::Kind::instance:
      return "a group cannot be part of a CSG object; use a [[csg.csg]] to move several parts together";
    default:
      return "";
  }
}

Blame why_not_closed(const shapes::ShapeType& type) {
  if (std::ranges::find(type.keys, "open", &reading::Key::name) != type.keys.end())
    return {"open", fmt::format("a CSG object is made of closed shapes: a {} that is open encloses nothing",
                                type.name)};
  return {"material", fmt::format("a CSG object is made of closed shapes: a {} encloses nothing", type.name)};
}

std::string why_two_media(const Shape& csg, const std::vector<std::unique_ptr<Material>>& materials) {
  int first = -1;
  std::string why;
  for_each_leaf(csg, [&](const Shape& leaf) {
    const int index = leaf.material;
    if (size_t(index) >= materials.size()) return;  // an error has left it without a material
    if (!materials[size_t(index)]->medium() || index == first) return;
    if (first >= 0 && why.empty())
      why = fmt::format(
          "a CSG object can be filled with only one medium, but light passes through its surfaces of \"{}\" "
          "and of \"{}\"",
          materials[size_t(first)]->name, materials[size_t(index)]->name);
    first = index;
  });
  return why;
}

}  // namespace eyeray::engine::loader
