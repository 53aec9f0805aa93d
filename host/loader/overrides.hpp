// -D: values laid over the files. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include <span>

#include "host/loader/scene_file.hpp"
#include "host/scene/diagnostic_log.hpp"

namespace eyeray::loader {

// Puts each value at its place in the tree, as if it stood in the file; it is checked with all others later.
void apply_overrides(toml::table& root, std::span<const Override> overrides, DiagnosticLog& log);

}  // namespace eyeray::loader
