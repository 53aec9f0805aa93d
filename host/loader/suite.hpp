// Folders of scenes.
#pragma once

#include <filesystem>
#include <vector>

namespace eyeray::engine::loader {

// The scene files in a folder and below it, by name: every .toml but those that another one there includes.
// Links to folders are not followed. Error (file_io) where a folder cannot be read, Error (bad_input) where
// there is none.
std::vector<std::filesystem::path> scenes_below(const std::filesystem::path& folder);

}  // namespace eyeray::engine::loader
