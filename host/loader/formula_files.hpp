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
  // Names in `scene` or in one of the other `sources`, which it includes, are relative to the folder of the
  // file that they stand in. Names that stand in no file (an override) are relative to the scene's.
  FormulaFiles(const AllowedFolders& folders, std::vector<std::filesystem::path> sources, DiagnosticLog& log)
      : folders_(folders), sources_(std::move(sources)), log_(log) {}

  std::optional<formula::FormulaText> load(const std::string& name, const SourcePosition& position) override;

  // Every file that was to be read, in the order in which they were first named.
  const std::vector<std::filesystem::path>& files() const { return files_; }

 private:
  const AllowedFolders& folders_;
  std::vector<std::filesystem::path> sources_;  // the scene first
  DiagnosticLog& log_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace eyeray::engine::loader
