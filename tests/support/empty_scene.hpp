#pragma once

#include "host/cameras/make.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::test {

// A scene with nothing in it but the camera of an empty file.
inline Scene empty_scene() {
  Scene scene;
  scene.camera.projection = cameras::make_projection(PerspectiveCamera{});
  return scene;
}

}  // namespace eyeray::engine::test
