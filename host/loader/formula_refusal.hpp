// Refuses functions in scenes that may not define any. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include "host/core/diagnostic_log.hpp"

namespace eyeray::engine::loader {

// Adds an error at each function of the scene: each `code`, and each `file` of an [[implicit]], a texture or
// a camera. If there are errors then, it throws InputError, so that no function is read.
void refuse_formulas(const toml::table& root, DiagnosticLog& log);

}  // namespace eyeray::engine::loader
