// The scene that a mesh file alone makes. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include <filesystem>

#include "host/importers/import.hpp"

namespace eyeray::engine::loader {

// The tables that a person would write to view the file: [[mesh]], and the file's camera and lights if it has
// them. Else a camera that frames `framed`, three quarters from the front with y up, a light over its left
// shoulder, and some ambient light. `around`: there will be an [environment], which takes the place of the
// background and of those lights.
toml::table mesh_scene(const std::filesystem::path& file, const importers::ImportedScene& import,
                       const importers::ImportedScene& framed, bool around);

}  // namespace eyeray::engine::loader
