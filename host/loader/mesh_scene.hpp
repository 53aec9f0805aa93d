// Makes a scene for a mesh file that is shown alone. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include <filesystem>

#include "host/importers/import.hpp"
#include "host/loader/scene_file.hpp"

namespace eyeray::engine::loader {

struct MeshView {
  bool around;  // there will be an [environment], which replaces background, ambient light and own lights
  bool usual_paths;  // paths go through no medium to the look's own background
  MeshLook look;
  bool formulas;             // the scene may have formulas, as a floor needs to fade
  bool transparent = false;  // the picture has an alpha: it shows no floor
  int turntable = 0;  // the frames in which the model turns once about the vertical; 0: it does not turn
  importers::ImportOptions reading = {};  // how the file was read
};

// True if the floor and the lights around the model are within the range of numbers.
bool has_room_for_studio(const importers::ImportedScene& framed);

// The tables that a person would write to view the file: [[mesh]], some ambient light, and the file's camera
// and lights. A missing camera is replaced by one that frames `framed`, three quarters from the front with y
// up. Missing lights are replaced by one over the camera's left shoulder and a weak one from its right.
// Looks other than plain have lights, a floor and settings of their own.
toml::table mesh_scene(const std::filesystem::path& file, const importers::ImportedScene& import,
                       const importers::ImportedScene& framed, const MeshView& view);

}  // namespace eyeray::engine::loader
