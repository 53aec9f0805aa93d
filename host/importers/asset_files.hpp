// The files that a mesh file names beside itself. Private to the importers.
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
  // For a file in memory: every asset is refused.
  AssetFiles() = default;
  // Names are relative to the folder of `file`. `allowed_folders`: where else than in its tree they may lie.
  AssetFiles(const std::filesystem::path& file, std::span<const std::filesystem::path> allowed_folders);

  // The path of the asset. `/` and `\` both separate folders. Error (bad_input) when it lies outside.
  std::filesystem::path locate(std::string_view name);
  // The bytes of the asset. Error (bad_input) when it lies outside, Error (file_io) when it cannot be read;
  // `what` stands in messages, such as "the buffer".
  std::string read(std::string_view name, std::string_view what);

  // Every asset that was asked for and may be read, once each.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  std::filesystem::path folder_;
  FolderTrees allowed_;  // nothing, until a file is known
  std::vector<std::filesystem::path> files_;
  std::set<std::filesystem::path> known_;  // the same
};

// The most that is read of one file.
inline constexpr size_t most_mesh_bytes = size_t{4} << 30;

}  // namespace eyeray::engine::importers
