#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace eyeray::engine {

// CRC-32 (that of zip, PNG and IEEE 802.3) of `bytes`, appended to the bytes whose checksum is `so_far`. It
// detects damage, not malice.
uint32_t crc32(std::span<const std::byte> bytes, uint32_t so_far = 0);

}  // namespace eyeray::engine
