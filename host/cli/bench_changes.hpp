// What changed between two answers of eyeray bench --json, for whole pictures.
#pragma once

#include <filesystem>
#include <string>

#include "host/cli/json.hpp"

namespace eyeray::cli {

// The pictures of an older answer. Error (file_io) where it cannot be read, Error (bad_input) where it is
// something else.
Json read_older_pictures(const std::filesystem::path& file);

// A line for the whole process, the tracing and the memory of each series that both have of a scene; pictures
// of another size or other samples are not compared.
std::string picture_changes(const Json& old, const Json& now);

}  // namespace eyeray::cli
