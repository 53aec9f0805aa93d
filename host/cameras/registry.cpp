#include "host/cameras/registry.hpp"

#include "shaders/cameras/rows.h"

namespace eyeray::engine::cameras {

// Each camera's .cpp defines its CameraType. A missing one is a link error that has its name.
#define X(name, ...) extern const CameraType name##_type;
CAMERAS(X)
#undef X

std::span<const CameraType* const> types() {
#define X(name, ...) &name##_type,
  static constexpr const CameraType* types[] = {CAMERAS(X)};
#undef X
  return types;
}

}  // namespace eyeray::engine::cameras
