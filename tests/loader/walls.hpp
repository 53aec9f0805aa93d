// Scenes of one material, "wall".
#pragma once

#include <fmt/format.h>

#include <string>

#include "host/loader/scene_file.hpp"

namespace eyeray::engine::test {

inline Scene parse_walls(const std::string& text) {
  return loader::parse_scene("[[material]]\nname = \"wall\"\ntype = \"phong\"\n" + text, "scene.toml");
}

// The error for the scene, or "accepted".
inline std::string refused(const std::string& text) {
  try {
    parse_walls(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

inline std::string sphere(const std::string& table, double x) {
  return fmt::format("[[{}]]\ncenter = [{}, 0, 0]\nradius = 1\nmaterial = \"wall\"\n", table, x);
}

}  // namespace eyeray::engine::test
