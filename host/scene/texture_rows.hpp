// The rows of shaders/textures/rows.h, for callers that need to know no more about a texture.
#pragma once

#include <cstdint>
#include <string_view>

#include "shaders/textures/rows.h"

namespace eyeray::engine {

struct TextureRow {
  std::string_view name;
  uint32_t number;
  bool varies;  // over a surface
};
inline constexpr TextureRow texture_rows[] = {
#define X(name, number, varies) {#name, number, varies},
    TEXTURES(X)
#undef X
};

}  // namespace eyeray::engine
