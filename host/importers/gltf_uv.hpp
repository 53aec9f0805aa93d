// The texture coordinates that a glTF picture takes. Private to this layer.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "host/core/vec.hpp"
#include "host/importers/gltf_json.hpp"
#include "host/textures/make.hpp"

namespace eyeray::engine::importers {

// The uv that a texture takes: the number of their set (TEXCOORD_0, …) in the mesh, and their transform. It
// applies before v is flipped, since glTF's v starts at the top of the picture.
struct GltfUv {
  uint64_t set = 0;
  glm::dmat2 linear{1.0};
  Vec2 offset{0.0};

  bool operator==(const GltfUv&) const = default;
};

// The uv of a reference to a texture, with KHR_texture_transform.
GltfUv uv_of(const GltfObject& reference);

// The position of a picture that takes `wanted`, in the first of the kinds of uv that allows it. A kind does
// not if one is turned or mirrored against the other: normal maps need the directions of u and v.
std::optional<textures::ImagePosition> position_among(std::span<const GltfUv> known, const GltfUv& wanted);

}  // namespace eyeray::engine::importers
