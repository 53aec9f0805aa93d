// Former names of keys in scene files, which are accepted for one more release. Private to the loader.
#pragma once

#include <toml++/toml.h>

#include <string_view>

namespace eyeray::engine::loader {

// The current name of `key` of a table: `key` itself, unless it is a former name.
std::string_view name_today(std::string_view key);

// Replaces each former name in `root`, and in the tables below it, by today's name.
void rename_former(toml::table& root);

}  // namespace eyeray::engine::loader
