// Turns TOML text from disk into a tree, with every syntax error in the log. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/statements.hpp"

namespace eyeray::engine::loader {

// The whole text of a regular file of at most 256 MiB. Error (file_io) with the system's reason, and a name
// in the same folder that the user may have meant.
std::string read_scene_text(const std::filesystem::path& file);

// The tree of `text`, with `name` as the file in its positions. A statement with a syntax error is reported
// and left out. A text that exceeds the budget is reported, and its tree is empty. Both mark the log as
// damaged.
toml::table parse_toml(std::string_view text, const std::string& name, TreeBudget& budget,
                       DiagnosticLog& log);

// The parser's error in a statement, reworded for a person who wants to fix it.
std::string explain_syntax(std::string_view description, std::string_view statement = {});

}  // namespace eyeray::engine::loader
