// Reads the text of a scene. Private to the loader.
#pragma once

#include <filesystem>
#include <string>

namespace eyeray::engine::loader {

// The whole text of a regular file of at most 256 MiB. Error (file_io) with the system's reason, and a name
// in the same folder that the user may have meant.
std::string read_scene_text(const std::filesystem::path& file);

}  // namespace eyeray::engine::loader
