#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace eyeray::engine {

// FNV-1a over 128 bits: names contents so that equal names mean equal contents, barring malice.
// Source: Fowler, Noll, Vo, Eastlake, "The FNV Non-Cryptographic Hash Algorithm" (IETF draft-eastlake-fnv).
class ContentHash {
 public:
  // Adds the length too, so that ("ab", "c") and ("a", "bc") differ.
  ContentHash& add(std::span<const std::byte> bytes);
  ContentHash& add(std::string_view text) { return add(std::as_bytes(std::span(text))); }

  // 32 hexadecimal digits.
  std::string hex() const;

 private:
  void add_byte(uint8_t byte);

  uint64_t high_ = 0x6c62272e07bb0142;
  uint64_t low_ = 0x62b821756295c58d;
};

// Hash of the contents of files. It does not depend on their paths. Paths that are no files are skipped.
// Error (file_io) when one cannot be read.
std::string hash_of_files(std::span<const std::filesystem::path> files);

}  // namespace eyeray::engine
