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
    std::filesystem::path path;   // as people know it
    std::filesystem::path whole;  // canonical: the same for every way to name the file
  };
  // The file that the value `name` of `key`, written in the file `from`, stands for; it need not exist. Error
  // (bad_input) where the name is none, or leads out of the allowed folders, links followed.
  File find(std::string_view key, const std::string& name, const std::filesystem::path& from) const;
  // Finds the file named by a value at a position. A value in none of the scene's `sources`, such as an
  // override, is relative to the scene's folder.
  File find(std::string_view key, const std::string& name, const std::string& from,
            std::span<const std::filesystem::path> sources) const;

 private:
  std::filesystem::path scene_;
  FolderTrees trees_;
};

}  // namespace eyeray::engine::loader
