#include "host/core/checksum.hpp"

#include <zlib.h>

namespace eyeray::engine {

uint32_t crc32(std::span<const std::byte> bytes, uint32_t so_far) {
  // For a null address zlib returns the checksum's initial value instead.
  if (bytes.empty()) return so_far;
  return uint32_t(crc32_z(so_far, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace eyeray::engine
