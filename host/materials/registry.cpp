#include "host/materials/registry.hpp"

#include "shaders/materials/rows.h"

namespace eyeray::engine::materials {

// Each material's .cpp defines its MaterialType. If one is missing, the link error names it.
#define X(name, number) extern const MaterialType name##_type;
MATERIALS(X)
#undef X

std::span<const MaterialType* const> types() {
#define X(name, number) &name##_type,
  static constexpr const MaterialType* types[] = {MATERIALS(X)};
#undef X
  return types;
}

}  // namespace eyeray::engine::materials
