// Numbers as words, and words as numbers. Private to this layer.
#pragma once

#include <bit>
#include <cstdint>

namespace eyeray::engine::emulator {

template <typename T>
T as(uint32_t word) {
  return std::bit_cast<T>(word);
}
inline uint32_t bits(float x) {
  return std::bit_cast<uint32_t>(x);
}
inline uint32_t bits(uint32_t x) {
  return x;
}
inline uint32_t bits(int32_t x) {
  return uint32_t(x);
}
inline uint32_t bits(bool x) {
  return x;
}

}  // namespace eyeray::engine::emulator
