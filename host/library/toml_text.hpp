// Values and tables of scenes built in code, as the TOML that the loader reads.
#pragma once

#include <eyeray/eyeray.hpp>

#include <string>
#include <string_view>

namespace eyeray::engine::library {

// A key, quoted where it has to be.
std::string key_text(std::string_view key);
// "key = value", a line each.
std::string lines(const v0::Table& table);

}  // namespace eyeray::engine::library
