// The facts about a kind of texture. A table's keys may have textures as values.
#pragma once

#include <span>
#include <string_view>

#include "host/core/vec.hpp"
#include "host/reading/key.hpp"
#include "host/scene/texture.hpp"

namespace eyeray::engine::reading {

class TableReader;  // reading/table_reader.hpp

struct TextureType {
  std::string_view name;  // in scene files, and of its .glsl
  std::string_view manual;
  std::span<const Key> keys = {};
  TexturePtr (*parse)(TableReader& table) = nullptr;  // null after an error, which is reported to the table
  // Makes the texture of a plain color; null for all kinds but the one that is written without a table.
  TexturePtr (*of_color)(const Vec3& color) = nullptr;

  // True if the type's name is one of its keys, and the other keys stand beside it: { image = "a.png",
  // wrap = … }. False if the keys stand in a table of that name: { checker = { … } }.
  bool is_flat() const {
    for (const Key& key : keys)
      if (key.name == name) return true;
    return false;
  }
};

}  // namespace eyeray::engine::reading
