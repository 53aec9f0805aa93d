// Values and tables of scenes built in code, as the TOML that the loader reads.
#pragma once

#include <eyeray/eyeray.hpp>

#include <string>
#include <string_view>

namespace eyeray::engine::library {

// A key as TOML, quoted if it must be.
std::string key_text(std::string_view key);
// The table's entries, each as a line "key = value".
std::string lines(const v0::Table& table);

}  // namespace eyeray::engine::library
