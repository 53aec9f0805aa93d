// Names that scene files had before, for one more release. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include <string_view>

namespace eyeray::engine::loader {

// The current name of `key` of a table: `key` itself, unless it is a former name.
std::string_view name_today(std::string_view key);

// Gives each table in `root` that has a former name the one it has today.
void rename_former(toml::table& root);

}  // namespace eyeray::engine::loader
