// A scene's files laid over each other: the scene itself, and the files it includes. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <vector>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/allowed_folders.hpp"

namespace eyeray::engine::loader {

// One TOML tree in which every top table is a known section: [name] a table, [[name]] a list of tables. What
// is not is reported and left out.
struct Document {
  toml::table root;
  std::vector<std::filesystem::path> files;  // the scene first
};

// Error (file_io) when the scene itself cannot be read; all else goes to the log.
Document read_document(const std::filesystem::path& scene, const AllowedFolders& folders, DiagnosticLog& log);
// A document without files; includes are refused.
Document parse_document(std::string_view text, const std::string& name, DiagnosticLog& log);

}  // namespace eyeray::engine::loader
