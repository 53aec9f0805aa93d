// The font files of one scene, each read once. Private to the loader.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/named_files.hpp"
#include "host/reading/font_source.hpp"

namespace eyeray::engine::loader {

class FontFiles final : public reading::FontSource {
 public:
  FontFiles(NamedFiles& files, DiagnosticLog& log) : files_(files), log_(log) {}

  std::shared_ptr<const std::string> load(const std::string& name, const SourcePosition& position) override;

 private:
  NamedFiles& files_;
  DiagnosticLog& log_;
  std::map<std::filesystem::path, std::shared_ptr<const std::string>> fonts_;  // by canonical path
};

}  // namespace eyeray::engine::loader
