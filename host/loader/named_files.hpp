// The images, formulas and fonts that one scene names. Private to the loader.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/loader/allowed_folders.hpp"

namespace eyeray::engine::loader {

class NamedFiles {
 public:
  // `sources`: the scene's file, then the files that it includes. A name in one of them is relative to that
  // file's folder. A name in none of them, such as an override, is relative to the scene's folder.
  NamedFiles(const AllowedFolders& folders, std::vector<std::filesystem::path> sources)
      : folders_(folders), sources_(std::move(sources)) {}

  // The file that `name`, the value of `key` at `position`, means. Error (bad_input) as AllowedFolders::find.
  AllowedFolders::File find(std::string_view key, const std::string& name,
                            const SourcePosition& position) const {
    return folders_.find(key, name, position.file, sources_);
  }

  // Adds a file that was requested. Returns false if it was before.
  bool add(const std::filesystem::path& file) {
    if (std::ranges::find(files_, file) != files_.end()) return false;
    files_.push_back(file);
    return true;
  }
  // Those files, in the order in which they were first requested.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  const AllowedFolders& folders_;
  std::vector<std::filesystem::path> sources_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace eyeray::engine::loader
