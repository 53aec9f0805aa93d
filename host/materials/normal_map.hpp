// Maps of normals and heights, as a scene's tables name them.
#pragma once

#include <optional>
#include <string_view>

#include "host/materials/registry.hpp"
#include "host/scene/material.hpp"

namespace eyeray::engine::materials {

// The texture as data: the codes of its image as they are, not as colours.
TexturePtr as_data(const TexturePtr& texture);

// The normal map of the key `key`, scaled by the number of the key `scale`; nothing if the table has no map.
// Reports a scale without a map.
std::optional<NormalMap> read_normal_map(TableReader& table, std::string_view key, std::string_view scale);

}  // namespace eyeray::engine::materials
