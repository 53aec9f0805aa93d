// A kernel file as TOML. Private to this layer.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "host/compute/kernel_keys.hpp"
#include "host/core/diagnostic_log.hpp"
#include "host/reading/table_reader.hpp"

namespace eyeray::engine::compute {

struct Document {
  std::filesystem::path file;
  toml::table root;
};

// The text of a kernel file; Error (file_io) if it cannot be read. Syntax errors go to the log.
Document read_document(const std::filesystem::path& file, DiagnosticLog& log);
// Sets the value of each KEY=VALUE at its key.
void apply_overrides(Document& document, const std::vector<std::string>& overrides, DiagnosticLog& log);

// The path that a value names: from the file's folder, or from the working folder if it is an override's.
std::filesystem::path path_at(const Document& document, const toml::node& node);

// Checks the keys of a table; `title` must outlive the reader.
reading::TableReader read_keys(Table table, std::string_view title, const toml::table& from,
                               DiagnosticLog& log);

// The table of a key; null if the key is missing, or, with an error, no table.
const toml::table* table_at(const toml::table& from, std::string_view key, DiagnosticLog& log);
// The strings of a key whose value is a list of them.
std::vector<const toml::node*> strings_at(const toml::table& from, std::string_view key, DiagnosticLog& log);
// One to three whole numbers of at least 1, the missing ones 1; nothing if the key is missing or wrong.
std::optional<std::array<uint32_t, 3>> sizes_at(const toml::table& from, std::string_view key,
                                                DiagnosticLog& log);

// "; did you mean `Source`?", or "; they are Source, Target".
std::string suggest(std::string_view name, const std::vector<std::string>& names);

}  // namespace eyeray::engine::compute
