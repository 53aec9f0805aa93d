// The files of formulas of one scene. Private to the loader.
#pragma once

#include <filesystem>
#include <vector>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/allowed_folders.hpp"
#include "host/reading/formula_source.hpp"

namespace eyeray::engine::loader {

class FormulaFiles final : public reading::FormulaSource {
 public:
  // `sources`: the scene's file, then the files that it includes. A name in one of them is relative to that
  // file's folder. A name in none of them, such as an override, is relative to the scene's folder.
  FormulaFiles(const AllowedFolders& folders, std::vector<std::filesystem::path> sources, DiagnosticLog& log)
      : folders_(folders), sources_(std::move(sources)), log_(log) {}

  std::optional<formula::FormulaText> load(const std::string& name, const SourcePosition& position) override;

  // Every file that was requested, in the order in which they were first named.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  const AllowedFolders& folders_;
  std::vector<std::filesystem::path> sources_;  // the scene first
  DiagnosticLog& log_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace eyeray::engine::loader
