// Refuses functions in scenes that may not define any. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include "host/core/diagnostic_log.hpp"

namespace eyeray::engine::loader {

// Adds an error at each `code` and `file` of an [[implicit]], wherever it stands, before any of them is read.
void refuse_formulas(const toml::table& root, DiagnosticLog& log);

}  // namespace eyeray::engine::loader
