#include "host/importers/malformed.hpp"

#include <algorithm>

#include "host/core/diagnostic_log.hpp"

namespace eyeray::engine::importers {

InputError malformed_at(const std::string& file, std::string_view text, size_t byte, std::string message) {
  byte = std::min(byte, text.size());
  int line = 1;
  size_t start = 0;
  for (size_t i = 0; i < byte; ++i) {
    // Lines may end with CR alone.
    const bool ends = text[i] == '\n' || (text[i] == '\r' && !text.substr(i + 1).starts_with('\n'));
    if (!ends) continue;
    ++line;
    start = i + 1;
  }
  return malformed(file, printable(message), line, static_cast<int>(byte - start) + 1);
}

}  // namespace eyeray::engine::importers
