// The tree of a glTF file's nodes. Private to the importers.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/importers/gltf_breaches.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::importers {

// The matrix translation · rotation · scale. A rotation that is not of unit length is a breach, and a
// rotation of length 0 an InputError; both are reported at the member `key` of `owner`.
Mat4 gltf_transform(const GltfObject& owner, const char* key, const Vec3& translation, const Vec4& rotation,
                    const Vec3& scale, GltfBreaches& breaches);

// True if the matrix is more than a rotation combined with a scale along each axis.
bool shears(const Mat3& matrix);

// The root nodes of a scene: that of the index `chosen`, or else the default. In a file without scenes, the
// nodes without a parent. `names`: the names of the file's scenes.
std::vector<size_t> root_nodes(const GltfObject& document, std::optional<size_t> chosen,
                               std::span<const std::string> names, std::vector<std::string>& warnings);

// The parent of each node, or `no_parent`.
constexpr size_t no_parent = ~size_t{0};
std::vector<size_t> parents_of_nodes(const GltfObject& document);

// True if KHR_node_visibility hides the node, and with it all nodes below it.
bool is_hidden(const GltfObject& node);

}  // namespace eyeray::engine::importers
