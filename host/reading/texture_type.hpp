// The facts about a kind of texture. Tables name textures among their values.
#pragma once

#include <span>
#include <string_view>

#include "host/core/vec.hpp"
#include "host/reading/key.hpp"
#include "host/scene/texture.hpp"

namespace eyeray::engine::reading {

class TableReader;  // reading/table_reader.hpp

struct TextureType {
  std::string_view name;  // as a scene file has it, and its .glsl
  std::string_view manual;
  std::span<const Key> keys = {};
  TexturePtr (*parse)(TableReader& table) = nullptr;  // null after an error, which is reported to the table
  // Only for the kind that is written as a plain color, without a table.
  TexturePtr (*of_color)(const Vec3& color) = nullptr;

  // True if its name is one of its keys and the others stand beside it: { image = "a.png", wrap = … }. False
  // if they are in a table of that name: { checker = { … } }.
  bool is_flat() const {
    for (const Key& key : keys)
      if (key.name == name) return true;
    return false;
  }
};

}  // namespace eyeray::engine::reading
