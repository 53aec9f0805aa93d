#include "host/core/content_hash.hpp"

#include <fmt/format.h>

#include "host/core/atomic_file.hpp"

namespace eyeray::engine {

ContentHash& ContentHash::add(std::span<const std::byte> bytes) {
  for (uint64_t length = bytes.size(), i = 0; i < 8; ++i) add_byte(uint8_t(length >> 8 * i));
  for (const std::byte byte : bytes) add_byte(uint8_t(byte));
  return *this;
}

void ContentHash::add_byte(uint8_t byte) {
  // Multiply by the prime 2^88 + 0x13b, modulo 2^128, in two halves.
  constexpr uint64_t prime_low = 0x13b;
  low_ ^= byte;
  const uint64_t product_low = (low_ & 0xffffffffu) * prime_low;
  const uint64_t product_high = (low_ >> 32) * prime_low + (product_low >> 32);
  high_ = high_ * prime_low + (product_high >> 32) + (low_ << 24);
  low_ = product_high << 32 | (product_low & 0xffffffffu);
}

std::string ContentHash::hex() const {
  return fmt::format("{:016x}{:016x}", high_, low_);
}

std::string hash_of_files(std::span<const std::filesystem::path> files) {
  ContentHash hash;
  for (const std::filesystem::path& file : files) {
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored)) hash.add(read_file(file));
  }
  return hash.hex();
}

}  // namespace eyeray::engine
