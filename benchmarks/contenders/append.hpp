#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <utility>

namespace eyeray::engine::contenders {

// Formats onto the end of a string.
template <typename... Args>
void append(std::string& text, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Args>(args)...);
}

}  // namespace eyeray::engine::contenders
