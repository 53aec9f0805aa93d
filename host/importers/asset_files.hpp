// The assets of a mesh file: the other files that it names. Private to the importers.
#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/folder_trees.hpp"

namespace eyeray::engine::importers {

class AssetFiles {
 public:
  // The assets of a file in memory: every one is refused.
  AssetFiles() = default;
  // Names are relative to the folder of `file`. An asset must lie in that folder's tree, or in the tree of
  // one of `allowed_folders`.
  AssetFiles(const std::filesystem::path& file, std::span<const std::filesystem::path> allowed_folders);

  // The path of the asset. `/` and `\` both separate folders. Error (bad_input) if it lies outside the
  // allowed folder trees.
  std::filesystem::path locate(std::string_view name);
  // The bytes of the asset. Error (bad_input) if it lies outside the allowed folder trees, Error (file_io) if
  // it cannot be read. `what` names the asset's use in messages: "the buffer".
  std::string read(std::string_view name, std::string_view what);

  // Every asset that was requested and may be read, once each.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  std::filesystem::path folder_;
  FolderTrees allowed_;  // no folder tree for a file in memory
  std::vector<std::filesystem::path> files_;
  std::set<std::filesystem::path> known_;  // the elements of files_
};

// Most bytes that are read of one file.
inline constexpr size_t most_mesh_bytes = size_t{4} << 30;

}  // namespace eyeray::engine::importers
