// Decompresses LZF, by which PCD files are compressed. Private to the importers.
// Source: Lehmann: liblzf, 2000; http://oldhome.schmorp.de/marc/liblzf.html
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace eyeray::engine::importers {

// The most bytes that so many compressed bytes can become: three bytes repeat 264 at most.
inline constexpr size_t most_lzf_bytes(size_t compressed) {
  return compressed * 88 + 1;
}

// The decompressed data, of exactly `size` bytes; empty if the data is damaged or of another size.
std::optional<std::string> decompress_lzf(std::string_view compressed, size_t size);

}  // namespace eyeray::engine::importers
