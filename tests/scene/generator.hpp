// Random scene files, with every key of every table in them. They contain the keys that the loader
// declares (Key), so a new shape or material takes part by itself.
#pragma once

#include <string>

#include "tests/support/random.hpp"

namespace eyeray::engine::test {

struct Wildness {
  double share = 0;   // share of extreme numbers and of degenerate structures
  bool legal = true;  // whether extreme numbers stay in the range of their key, and nothing is misspelt
};

// The text of a scene: a camera, up to three lights, materials and shapes. Without wildness, nearly every
// scene renders.
std::string random_scene_text(Random& random, const Wildness& wildness);

}  // namespace eyeray::engine::test
