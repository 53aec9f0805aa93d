// Folders and files that nobody else can have changed: caches trust no others.
#pragma once

#include <filesystem>
#include <string>

namespace eyeray::engine {

// True if the path itself, not a link there, is a folder (a regular file) of this user that nobody else may
// write to.
bool is_private_folder(const std::filesystem::path& folder);
bool is_private_file(const std::filesystem::path& file);

// The reason why the path is no private folder, worded to follow "it is not used: ". "" if it is a private
// folder or does not exist.
std::string why_not_private(const std::filesystem::path& folder);

// Makes the folder, and its parents, where there is none. False if there is then no private folder.
bool make_private_folder(const std::filesystem::path& folder);

}  // namespace eyeray::engine
