#include "host/lights/registry.hpp"

#include "shaders/lights/rows.h"

namespace eyeray::engine::lights {

// Each light's .cpp defines its LightType. A missing one is a link error that has its name.
#define X(name, number) extern const LightType name##_type;
LIGHTS(X)
#undef X

std::span<const LightType* const> types() {
#define X(name, number) &name##_type,
  static constexpr const LightType* types[] = {LIGHTS(X)};
#undef X
  return types;
}

}  // namespace eyeray::engine::lights
