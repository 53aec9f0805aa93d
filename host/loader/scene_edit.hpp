// Changes a value in a scene file, and leaves the rest as its author wrote it.
#pragma once

#include <filesystem>
#include <string>

namespace eyeray::engine::loader {

// Writes `key = value` of [table] into the scene file: over the value that stands there, or as a new line.
// Error (bad_input) if the file is no TOML or is written in a form in which the value cannot be found. Error
// (file_io) if the file cannot be read or written. The file is replaced as a whole or not at all.
void set_value(const std::filesystem::path& file, const std::string& table, const std::string& key,
               const std::string& value);

// The text with the value changed.
std::string with_value(std::string text, const std::string& table, const std::string& key,
                       const std::string& value);

}  // namespace eyeray::engine::loader
