// Parts of JSON output that several commands share.
#pragma once

#include <exception>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "host/core/diagnostic.hpp"
#include "host/core/error.hpp"
#include "host/core/stopwatch.hpp"

namespace eyeray::engine::program {

// Keeps the order in which keys were added, so that people can read it too.
using Json = nlohmann::ordered_json;

// {"severity", "file", "line", "column", "message"}; line and column are absent where unknown.
Json to_json(const Diagnostic& diagnostic);
// {"code": 2, "message": "…", "diagnostics": […]}: the answer of a command under --json when it fails.
// "diagnostics" are there for scenes and shaders.
Json to_json(const Error& error);
// {"load": 0.001, …}, seconds.
Json to_json(const StageTimes& times);

// One line of text on standard output.
void print_json(const Json& json);

}  // namespace eyeray::engine::program
