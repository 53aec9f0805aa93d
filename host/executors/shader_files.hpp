// The sources of shader text: text made for the scene, a folder that overrides embedded shaders, and the
// embedded shaders.
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace eyeray::engine::executors {

class ShaderFiles {
 public:
  // `folder`: laid over the embedded shaders, file by file; empty: none. Error (file_io) when it is not a
  // folder; InputError where its records.h differs from the one that the program was compiled
  // with.
  ShaderFiles(std::filesystem::path folder, std::string scene_glsl);

  const std::filesystem::path& folder() const { return folder_; }
  // The text of a file such as "shapes/sphere.glsl"; nothing if there is no such file.
  std::optional<std::string> read(std::string_view name);
  // eyeray's own text of a file that the folder has; empty if eyeray has no such file. Nothing if the folder
  // lacks it.
  std::optional<std::string_view> replaced(std::string_view name) const;
  // The name for people: the path in the folder if the text came from there, else the name.
  std::string shown(const std::string& name) const;
  // True if any text came from the folder. If none did, an error of compilation is a fault of eyeray itself.
  bool gave_users() const { return gave_users_; }
  // The paths in the folder that were searched for, found or not: for a watcher.
  const std::set<std::filesystem::path>& looked_for() const { return looked_for_; }

 private:
  std::filesystem::path folder_;
  std::string scene_glsl_;
  std::set<std::filesystem::path> looked_for_;
  bool gave_users_ = false;
};

// The paths in `folder` of the files that take the place of embedded shaders and differ from them. No path if
// `folder` is empty.
std::vector<std::string> changed_shaders(const std::filesystem::path& folder);

}  // namespace eyeray::engine::executors
