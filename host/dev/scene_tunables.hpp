// Values of a scene that a person adjusts while viewing the picture:
//
//   radius = 1.25                 # @slider 0.1 3
//   diffuse = [0.8, 0.3, 0.15]    # @color
//   two_sided = true              # @checkbox
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace eyeray::engine::dev {

struct SceneTunable {
  std::string key;  // as -D takes it: "material.2.diffuse.formula.parameters.size"
  // For people: the owner, called by its `name`, its `file`'s name or its kind ("bricks", "sphere 2"); and
  // the tunable's own name ("diffuse size").
  std::string owner, name;
  std::string type;  // "float", "int", "bool" or "vec3"
  double low = 0, high = 1;
  std::array<double, 3> written{};  // the value in the file: three numbers for a vec3, else one
};

// The tunables of a scene file's text, where each stands on a separate line.
std::vector<SceneTunable> scene_tunables(std::string_view text);

}  // namespace eyeray::engine::dev
