// The font files of one scene, each read once. Private to the loader.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/allowed_folders.hpp"
#include "host/reading/font_source.hpp"

namespace eyeray::engine::loader {

class FontFiles final : public reading::FontSource {
 public:
  // `sources`: as in FormulaFiles.
  FontFiles(const AllowedFolders& folders, std::vector<std::filesystem::path> sources, DiagnosticLog& log)
      : folders_(folders), sources_(std::move(sources)), log_(log) {}

  std::shared_ptr<const std::string> load(const std::string& name, const SourcePosition& position) override;

  // Every file that was requested, in the order in which they were first named.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  const AllowedFolders& folders_;
  std::vector<std::filesystem::path> sources_;  // the scene first
  DiagnosticLog& log_;
  std::vector<std::filesystem::path> files_;
  std::map<std::filesystem::path, std::shared_ptr<const std::string>> fonts_;  // by canonical path
};

}  // namespace eyeray::engine::loader
