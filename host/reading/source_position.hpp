// Where something stands in its file.
#pragma once

#include <toml++/toml.h>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine::reading {

SourcePosition position_of(const toml::source_region& source);
// Where the text begins that a string stands for, as far as that can be told: escapes are not looked at.
SourcePosition start_of_text(const toml::node& node);

}  // namespace eyeray::engine::reading
