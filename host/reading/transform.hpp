// A list of transform steps as one matrix. Private to this layer.
#pragma once

#include <toml++/toml.h>

#include <optional>

#include "host/core/diagnostic_log.hpp"
#include "host/core/vec.hpp"

namespace eyeray::engine::reading {

// The steps applied in the order written; nothing, with errors in the log, where a step is wrong or the whole
// cannot be undone.
std::optional<Mat4> read_transform(const toml::array& steps, DiagnosticLog& log);

// A turn about an axis through the origin.
std::optional<Mat4> read_rotation(const toml::table& table, DiagnosticLog& log);

}  // namespace eyeray::engine::reading
