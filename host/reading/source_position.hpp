// Positions of TOML nodes in their files.
#pragma once

#include <toml++/toml.h>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine::reading {

SourcePosition position_of(const toml::source_region& source);
// The position at which a string's text begins. Escapes in the text are not considered.
SourcePosition start_of_text(const toml::node& node);

}  // namespace eyeray::engine::reading
