// A ball over a chequered floor, for tests of how pictures are made.
#pragma once

#include <string>

namespace eyeray::engine::test {

// `image`: the keys of [image]. `ball`: those of the ball's material.
inline std::string ball_over_floor(const std::string& image, const std::string& ball) {
  return "[image]\n" + image + R"(
[camera]
eye = [0, 1, 6]
target = [0, 0.6, 0]
[render]
ambient = 0.2
background = [0.2, 0.4, 0.7]
[[light]]
type = "point"
position = [3, 6, 4]
intensity = 30
[[material]]
name = "floor"
type = "phong"
diffuse = { checker = { even = 0.9, odd = [0.3, 0.1, 0.1], size = 0.7 } }
[[plane]]
point = [0, 0, 0]
normal = [0, 1, 0]
material = "floor"
[[sphere]]
center = [0.3, 1, 0]
radius = 1
material = "ball"
[[material]]
name = "ball"
)" + ball;
}

}  // namespace eyeray::engine::test
