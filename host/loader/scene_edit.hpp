// Changes to a scene file that leave all else in it as its author wrote it.
#pragma once

#include <filesystem>
#include <string>

namespace eyeray::engine::loader {

// Writes `key = value` of [table] into the scene file: over the value that stands there, or as a new line.
// Error (bad_input) where the file is no TOML or the value stands so that it cannot be found, Error (file_io)
// where the file cannot be read or written. It is replaced whole or not at all.
void set_value(const std::filesystem::path& file, const std::string& table, const std::string& key,
               const std::string& value);

// The text with the value changed.
std::string with_value(std::string text, const std::string& table, const std::string& key,
                       const std::string& value);

}  // namespace eyeray::engine::loader
