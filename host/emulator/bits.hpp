// Numbers as words, and words as numbers. Private to this layer.
//
// A number of 8 or 16 bits is the low bits of a word, and the others are 0. A number of 64 bits is two words,
// the low one first.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

namespace eyeray::engine::emulator {

// A float of 16 bits. It is computed as a float of 32 bits, and then rounded.
struct Half {};

template <typename T>
constexpr bool is_real = std::is_floating_point_v<T> || std::is_same_v<T, Half>;

// The type that a number of type T is computed in.
template <typename T>
using Computed =
    std::conditional_t<std::is_same_v<T, Half>, float,
                       std::conditional_t<std::is_integral_v<T> && !std::is_same_v<T, bool> && sizeof(T) < 4,
                                          std::conditional_t<std::is_signed_v<T>, int32_t, uint32_t>, T>>;

template <typename T>
constexpr uint32_t words_of = sizeof(T) == 8 ? 2 : 1;

float half_to_float(uint32_t half);
// To the nearest half, halfway cases to the even one.
uint32_t to_half(double x);

template <typename T>
Computed<T> number_of(uint32_t low, uint32_t high = 0) {
  if constexpr (std::is_same_v<T, Half>)
    return half_to_float(low);
  else if constexpr (sizeof(T) == 8)
    return std::bit_cast<T>(uint64_t{high} << 32 | low);
  else if constexpr (sizeof(T) == 4)
    return std::bit_cast<T>(low);
  else
    return Computed<T>(T(low));
}

// Both words of a number, the low one in the low half.
template <typename T>
uint64_t words_of_number(Computed<T> x) {
  if constexpr (std::is_same_v<T, Half>)
    return to_half(double(x));
  else if constexpr (sizeof(T) == 8)
    return std::bit_cast<uint64_t>(x);
  else if constexpr (sizeof(T) == 4)
    return std::bit_cast<uint32_t>(x);
  else if constexpr (std::is_same_v<T, bool>)
    return x;
  else
    return std::make_unsigned_t<T>(x);
}

// The nearest number of type T.
template <typename T>
Computed<T> rounded(Computed<T> x) {
  const uint64_t words = words_of_number<T>(x);
  return number_of<T>(uint32_t(words), uint32_t(words >> 32));
}

// A NaN that an operation made of other numbers carries the number of its birth, from 1 to `most_births`, in
// bits that IEEE 754 leaves to us. Operations, conversions between floats and copies hand these bits on. They
// are taken away where the NaN leaves the kernel or becomes a whole number.
constexpr uint32_t most_births = 0xffff;

// The birth that this word of a float of `bits` bits names, or 0. Of 64 bits it is the high word.
inline uint32_t birth_of(uint32_t word, uint32_t bits) {
  if (bits == 32 && (word & 0x7fe00007u) == 0x7fe00000u && (word & 0x1fffffu) >> 3 <= most_births)
    return (word & 0x1fffffu) >> 3;
  if (bits == 64 && (word & 0x7ffc0000u) == 0x7ffc0000u && (word & 0x3ffffu) <= most_births)
    return word & 0x3ffffu;
  return bits == 16 && (word & 0x7fffu) == 0x7f00u ? word >> 16 : 0;
}
inline uint32_t with_birth(uint32_t word, uint32_t bits, uint32_t birth) {
  if (bits == 32) return word | 0x7fe00000u | birth << 3;
  if (bits == 64) return word | 0x7ffc0000u | birth;
  return word | 0x7f00u | birth << 16;
}
inline uint32_t without_birth(uint32_t word, uint32_t bits) {
  if (birth_of(word, bits) == 0) return word;
  const uint32_t sign = bits == 16 ? word & 0x8000u : word & 0x80000000u;
  return sign | (bits == 32 ? 0x7fc00000u : bits == 64 ? 0x7ff80000u : 0x7e00u);
}

}  // namespace eyeray::engine::emulator
