// The scenes that are measured when none is given: they are known from Haines' databases, or have an
// interesting size.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "host/scene/scene.hpp"

namespace eyeray::engine::bench {

struct StandardScene {
  std::string_view name;    // "terrain-1m"
  std::string_view family;  // "terrain": the same for the scene at another size
  Scene (*make)();          // in memory: nothing is written
  // Writes the scene as a scene file, "NAME.toml", with a mesh beside it as .ply. Error (file_io).
  void (*write)(const std::filesystem::path& file);
};

std::span<const StandardScene> standard_scenes();
// nullptr for another name.
const StandardScene* find_standard_scene(std::string_view name);

}  // namespace eyeray::engine::bench
