// Turns TOML text into a tree, with every syntax error in the log. Private to this layer and to
// those that read files of TOML.
#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>

#include "host/core/diagnostic_log.hpp"
#include "host/reading/statements.hpp"

namespace eyeray::engine::reading {

// The tree of `text`, with `name` as the file in its positions. A statement with a syntax error is reported
// and left out. A text that exceeds the budget is reported, and its tree is empty. Both mark the log as
// damaged.
toml::table parse_toml(std::string_view text, const std::string& name, TreeBudget& budget,
                       DiagnosticLog& log);

// The parser's error in a statement, reworded for a person who wants to fix it.
std::string explain_syntax(std::string_view description, std::string_view statement = {});

}  // namespace eyeray::engine::reading
