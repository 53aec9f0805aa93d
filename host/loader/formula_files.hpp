// The files of formulas of one scene. Private to the loader.
#pragma once

#include <optional>
#include <string>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/named_files.hpp"
#include "host/reading/formula_source.hpp"

namespace eyeray::engine::loader {

class FormulaFiles final : public reading::FormulaSource {
 public:
  FormulaFiles(NamedFiles& files, DiagnosticLog& log) : files_(files), log_(log) {}

  std::optional<formula::FormulaText> load(const std::string& name, const SourcePosition& position) override;

 private:
  NamedFiles& files_;
  DiagnosticLog& log_;
};

}  // namespace eyeray::engine::loader
