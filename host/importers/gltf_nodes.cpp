#include "host/importers/gltf_nodes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "host/importers/import.hpp"

namespace eyeray::engine::importers {

Mat4 gltf_transform(const GltfObject& owner, const char* key, const Vec3& translation, const Vec4& rotation,
                    const Vec3& scale, GltfBreaches& breaches) {
  const glm::dquat turn(rotation.w, rotation.x, rotation.y, rotation.z);
  if (!(glm::length(turn) > 1e-6)) owner.fail("has a rotation of length 0");
  if (std::abs(glm::length(turn) - 1) > 0.01)
    breaches.add("rotations that are not of unit length, normalised", owner.location() + "." + key);
  return glm::translate(Mat4(1.0), translation) * glm::mat4_cast(glm::normalize(turn)) *
         glm::scale(Mat4(1.0), scale);
}

bool shears(const Mat3& matrix) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 &a = matrix[i], &b = matrix[(i + 1) % 3];
    if (std::abs(glm::dot(a, b)) > 1e-3 * glm::length(a) * glm::length(b)) return true;
  }
  return false;
}

std::vector<size_t> parents_of_nodes(const GltfObject& document) {
  const size_t nodes = document.size("nodes");
  std::vector<size_t> parents(nodes, no_parent);
  for (size_t i = 0; i < nodes; ++i) {
    for (const size_t below : document.element("nodes", i).indices("children", nodes)) parents[below] = i;
  }
  return parents;
}

std::vector<size_t> root_nodes(const GltfObject& document, std::optional<size_t> chosen,
                               std::span<const std::string> names, std::vector<std::string>& warnings) {
  const size_t nodes = document.size("nodes");
  const size_t scenes = document.size("scenes");
  if (scenes > 0) {
    const auto shown = chosen ? chosen : document.index("scene", scenes);
    if (!shown && scenes == 1) warnings.emplace_back("it has no default scene: its only scene is shown");
    if (!shown && scenes > 1)
      warnings.push_back(
          fmt::format("it has no default scene: the first of {} is shown; `gltf_scene` or "
                      "--gltf-scene shows another: {}",
                      scenes, list_names(names)));
    return document.element("scenes", shown.value_or(0)).indices("nodes", nodes);
  }
  warnings.emplace_back("it has no scenes: all nodes without a parent are shown");
  const std::vector<size_t> parents = parents_of_nodes(document);
  std::vector<size_t> roots;
  for (size_t i = 0; i < nodes; ++i) {
    if (parents[i] == no_parent) roots.push_back(i);
  }
  return roots;
}

bool is_hidden(const GltfObject& node) {
  const auto visibility = node.extension("KHR_node_visibility");
  return visibility && visibility->has("visible") && !visibility->flag("visible");
}

}  // namespace eyeray::engine::importers
