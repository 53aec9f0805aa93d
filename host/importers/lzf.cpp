#include "host/importers/lzf.hpp"

#include <cstdint>

namespace eyeray::engine::importers {

std::optional<std::string> decompress_lzf(std::string_view compressed, size_t size) {
  std::string out;
  out.reserve(size);
  size_t at = 0;
  const auto left = [&] { return compressed.size() - at; };
  const auto next = [&] { return static_cast<size_t>(static_cast<unsigned char>(compressed[at++])); };
  while (left() > 0) {
    const size_t control = next();
    if (control < 32) {
      // The next bytes as they are.
      const size_t length = control + 1;
      if (length > left() || length > size - out.size()) return std::nullopt;
      out.append(compressed.substr(at, length));
      at += length;
      continue;
    }
    // Bytes from before, which may overlap those that they become.
    size_t length = control >> 5;
    if (length == 7) {
      if (left() == 0) return std::nullopt;
      length += next();
    }
    length += 2;
    if (left() == 0) return std::nullopt;
    const size_t back = ((control & 31) << 8) + next() + 1;
    if (back > out.size() || length > size - out.size()) return std::nullopt;
    for (size_t i = 0; i < length; ++i) out.push_back(out[out.size() - back]);
  }
  if (out.size() != size) return std::nullopt;
  return out;
}

}  // namespace eyeray::engine::importers
