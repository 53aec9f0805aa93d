#include "host/textures/registry.hpp"

#include "shaders/textures/rows.h"

namespace eyeray::engine::textures {

// Each texture's .cpp defines its own TextureType. If one is missing, the linker's error contains its name.
#define X(name, ...) extern const TextureType name##_type;
TEXTURES(X)
#undef X

std::span<const TextureType* const> types() {
#define X(name, ...) &name##_type,
  static constexpr const TextureType* types[] = {TEXTURES(X)};
#undef X
  return types;
}

}  // namespace eyeray::engine::textures
