// Merges a scene's files: the scene itself, and the files that it includes. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <vector>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/allowed_folders.hpp"

namespace eyeray::engine::loader {

// One TOML tree in which every top-level entry is a known section: [name] is a table, [[name]] a list of
// tables. Any other entry is reported and left out.
struct Document {
  toml::table root;
  std::vector<std::filesystem::path> files;  // the scene first
};

// Reads and merges the files of a scene. Error (file_io) if the scene itself cannot be read; all other errors
// go to the log.
Document read_document(const std::filesystem::path& scene, const AllowedFolders& folders, DiagnosticLog& log);
// Reads a document from text, without files: includes are refused.
Document parse_document(std::string_view text, const std::string& name, DiagnosticLog& log);

}  // namespace eyeray::engine::loader
