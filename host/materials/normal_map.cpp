#include "host/materials/normal_map.hpp"

#include <fmt/format.h>

#include "host/materials/registry.hpp"

namespace eyeray::engine::materials {

TexturePtr as_data(const TexturePtr& texture) {
  const TexturePtr data = texture ? texture->as_data() : nullptr;
  return data ? data : texture;
}

std::optional<NormalMap> read_normal_map(TableReader& table, std::string_view key, std::string_view scale) {
  if (table.has(key)) return NormalMap{as_data(table.texture(key)), table.number(scale)};
  if (table.has(scale)) table.error(scale, fmt::format("this key needs a `{}` to scale", key));
  return std::nullopt;
}

}  // namespace eyeray::engine::materials
