// TOML nodes that are expressions in place of numbers.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string_view>
#include <vector>

#include "host/core/diagnostic_log.hpp"
#include "host/reading/number_expression.hpp"

namespace eyeray::engine::reading {

// The text of a node that is an expression; "" for any other node.
std::string_view expression_of(const toml::node& node);
// The numbers of an expression; nothing, with an error in the log, if it is wrong.
std::optional<std::vector<double>> evaluate(const toml::node& node, const Variables& variables,
                                            DiagnosticLog& log);

}  // namespace eyeray::engine::reading
