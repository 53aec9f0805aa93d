// The position of a world point in the picture of a scene.
#pragma once

#include "tests/support/camera.hpp"

namespace eyeray::engine::test {

// The point's position in the picture, in pixels from the top left corner.
inline Vec2 pixel(const Scene& scene, const Vec3& point) {
  const Vec2 position = position_seen(scene, point);
  return {(1 + position.x) / 2 * scene.image.width,
          (scene.image.height - position.y * scene.image.width) / 2};
}

}  // namespace eyeray::engine::test
