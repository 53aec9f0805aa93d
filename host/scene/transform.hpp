// A list of transform steps as one matrix. Private to the scene layer.
#pragma once

#include <toml++/toml.h>

#include <optional>

#include "host/core/vec.hpp"
#include "host/scene/diagnostic_log.hpp"

namespace eyeray {

// The steps applied in the order written; nothing, with errors in the log, where a step is wrong or the whole
// cannot be undone.
std::optional<Mat4> read_transform(const toml::array& steps, DiagnosticLog& log);

// A turn about an axis through the origin.
std::optional<Mat4> read_rotation(const toml::table& table, DiagnosticLog& log);

}  // namespace eyeray
