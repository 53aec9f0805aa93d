#include "host/importers/malformed.hpp"

#include <algorithm>

#include "host/core/diagnostic_log.hpp"

namespace eyeray::engine::importers {

InputError malformed_at(const std::string& file, std::string_view text, size_t byte, std::string message) {
  byte = std::min(byte, text.size());
  const std::string_view before = text.substr(0, byte);
  const size_t start = before.rfind('\n') + 1;  // 0 if there is no line break
  const auto line = 1 + std::ranges::count(before, '\n');
  return malformed(file, printable(message), static_cast<int>(line), static_cast<int>(byte - start) + 1);
}

}  // namespace eyeray::engine::importers
