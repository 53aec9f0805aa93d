// The position of something in its file.
#pragma once

#include <toml++/toml.h>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine::reading {

SourcePosition position_of(const toml::source_region& source);
// The position where a string's text begins. Escapes in it are not considered.
SourcePosition start_of_text(const toml::node& node);

}  // namespace eyeray::engine::reading
