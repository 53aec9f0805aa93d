// Finds the scenes in a folder.
#pragma once

#include <filesystem>
#include <vector>

namespace eyeray::engine::loader {

// The scene files in a folder and below it, sorted by name: every .toml except those that another one there
// includes. Links to folders are not followed. Error (file_io) if a folder cannot be read, Error (bad_input)
// if there is no scene.
std::vector<std::filesystem::path> scenes_below(const std::filesystem::path& folder);

}  // namespace eyeray::engine::loader
