#pragma once

#include <filesystem>

namespace eyeray::engine {

// Makes the folder, and its parents, where there is none. Error (file_io) with the folder's name and the
// reason.
void make_folder(const std::filesystem::path& folder);

}  // namespace eyeray::engine
