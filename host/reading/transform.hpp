// Reads a list of transform steps as one matrix. Private to this layer.
#pragma once

#include <toml++/toml.h>

#include <optional>

#include "host/core/diagnostic_log.hpp"
#include "host/core/vec.hpp"
#include "host/reading/value.hpp"

namespace eyeray::engine::reading {

// The matrix that applies the steps in the order written. Nothing, with errors in the log, if a step is wrong
// or the matrix cannot be inverted.
std::optional<Mat4> read_transform(const toml::array& steps, DiagnosticLog& log, const ValueSources& sources);

// The rotation about an axis through the origin; nothing after an error.
std::optional<Mat4> read_rotation(const toml::table& table, DiagnosticLog& log, const ValueSources& sources);

}  // namespace eyeray::engine::reading
