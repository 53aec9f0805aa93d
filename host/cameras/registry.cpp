#include "shaders/cameras/registry.h"

#include "host/cameras/make.hpp"

namespace eyeray {

// Each camera's .cpp defines its own; one that is missing is a link error that bears its name.
#define X(name, number) extern const CameraType name##_camera;
CAMERAS(X)
#undef X

std::span<const CameraType* const> camera_types() {
#define X(name, number) &name##_camera,
  static constexpr const CameraType* types[] = {CAMERAS(X)};
#undef X
  return types;
}

std::shared_ptr<const Projection> default_projection() {
  return make_projection(PerspectiveCamera{});
}

}  // namespace eyeray
