// Makes a scene for a mesh file that is shown alone. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include <filesystem>

#include "host/importers/import.hpp"

namespace eyeray::engine::loader {

// The tables that a person would write to view the file: [[mesh]], some ambient light, and the file's camera
// and lights. A missing camera is replaced by one that frames `framed`, three quarters from the front with y
// up. Missing lights are replaced by one over the camera's left shoulder and a weak one from its right.
// `around`: there will be an [environment], which takes the place of the background, the ambient light and
// those lights.
toml::table mesh_scene(const std::filesystem::path& file, const importers::ImportedScene& import,
                       const importers::ImportedScene& framed, bool around);

}  // namespace eyeray::engine::loader
