// Errors with which importers refuse the contents of a file. Private to the importers.
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine::importers {

// The error "bunny.obj:12:3: error: message"; without a position if `line` is 0.
inline InputError malformed(const std::string& file, std::string message, int line = 0, int column = 0) {
  return InputError({{Severity::error, {file, line, column}, std::move(message), "", 1}});
}

// The error at a byte of a text. Its line and column are counted in the text.
InputError malformed_at(const std::string& file, std::string_view text, size_t byte, std::string message);

}  // namespace eyeray::engine::importers
