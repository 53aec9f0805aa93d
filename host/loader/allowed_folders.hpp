// The other files that a scene may read: those in its own folder tree, and in trees that the user allowed.
// Private to the loader.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "host/core/folder_trees.hpp"

namespace eyeray::engine::loader {

class AllowedFolders {
 public:
  // `scene`: the file of the scene itself.
  AllowedFolders(const std::filesystem::path& scene, std::span<const std::filesystem::path> others);

  struct File {
    std::filesystem::path path;   // as messages show it
    std::filesystem::path whole;  // the canonical path: the same for every way to name the file
  };
  // The file that `name` means: the value of `key`, written in the file `from`. The file need not exist.
  // Error (bad_input) if the name is none, or if it leads out of the allowed folders after links are
  // followed.
  File find(std::string_view key, const std::string& name, const std::filesystem::path& from) const;
  // The file that `name` means, where `from` may be no file: a value that is in none of the scene's
  // `sources`, such as an override, is relative to the scene's folder.
  File find(std::string_view key, const std::string& name, const std::string& from,
            std::span<const std::filesystem::path> sources) const;

 private:
  std::filesystem::path scene_;
  FolderTrees trees_;
};

}  // namespace eyeray::engine::loader
