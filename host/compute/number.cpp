#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "host/compute/type.hpp"

namespace eyeray::engine::compute {
namespace {

// The number's bits.
uint64_t bits_at(const Number& number, const std::byte* at) {
  uint64_t bits = 0;
  std::memcpy(&bits, at, number.bytes());
  return bits;
}

int64_t as_signed(const Number& number, uint64_t bits) {
  const uint32_t unused = 64 - number.bits;
  return int64_t(bits << unused) >> unused;
}

double real_of_half(uint64_t half) {
  const int exponent = int(half >> 10 & 31);
  const double mantissa = double(half & 1023);
  const double size = exponent == 31  ? (mantissa == 0 ? std::numeric_limits<double>::infinity()
                                                       : std::numeric_limits<double>::quiet_NaN())
                      : exponent == 0 ? std::ldexp(mantissa, -24)
                                      : std::ldexp(1024 + mantissa, exponent - 25);
  return half >> 15 ? -size : size;
}

// The half that is nearest, or the even one of two.
uint16_t half_of_real(double value) {
  const uint16_t sign = std::signbit(value) ? 0x8000 : 0;
  const double size = std::fabs(value);
  if (std::isnan(value)) return sign | 0x7e00;
  int exponent = 0;
  std::frexp(size, &exponent);  // size is below 2^exponent
  const int unit = std::max(exponent - 11, -24);
  const double scaled = std::nearbyint(std::ldexp(size, -unit));
  if (size >= 65520) return sign | 0x7c00;
  // A mantissa that rounds up to 2048 is the next exponent's first.
  return uint16_t(sign |
                  (scaled < 1024 ? uint64_t(scaled) : (uint64_t(unit + 25) << 10) + uint64_t(scaled) - 1024));
}

double real_of(const Number& number, uint64_t bits) {
  if (number.bits == 64) return std::bit_cast<double>(bits);
  return number.bits == 32 ? double(std::bit_cast<float>(uint32_t(bits))) : real_of_half(bits);
}

// Reals in order as integers.
int64_t ordered(const Number& number, uint64_t bits) {
  const uint64_t sign = uint64_t{1} << (number.bits - 1);
  return bits & sign ? -int64_t(bits & ~sign) : int64_t(bits);
}

}  // namespace

double read_number(const Number& number, const std::byte* at) {
  const uint64_t bits = bits_at(number, at);
  if (number.kind == NumberKind::real) return real_of(number, bits);
  return number.kind == NumberKind::signed_integer ? double(as_signed(number, bits)) : double(bits);
}

std::string show_number(const Number& number, const std::byte* at) {
  const uint64_t bits = bits_at(number, at);
  if (number.kind == NumberKind::unsigned_integer) return fmt::format("{}", bits);
  if (number.kind == NumberKind::signed_integer) return fmt::format("{}", as_signed(number, bits));
  if (number.bits == 32) return fmt::format("{}", std::bit_cast<float>(uint32_t(bits)));
  return fmt::format("{}", real_of(number, bits));
}

bool write_number(const Number& number, double value, std::byte* at) {
  if (number.kind != NumberKind::real) {
    // The bounds are below the first integer that an int64_t lacks.
    if (std::isnan(value) || std::trunc(value) != value || std::fabs(value) > 0x1p62) return false;
    return write_number(number, int64_t(value), at);
  }
  if (number.bits == 64) return std::memcpy(at, &value, 8), true;
  const auto single = float(value);
  const uint16_t half = number.bits == 16 ? half_of_real(value) : uint16_t{0};
  std::memcpy(at, number.bits == 16 ? static_cast<const void*>(&half) : &single, number.bytes());
  return true;
}

bool write_number(const Number& number, int64_t value, std::byte* at) {
  if (number.kind == NumberKind::real) return write_number(number, double(value), at);
  const auto bits = uint64_t(value);
  const uint32_t unused = 64 - number.bits;
  const bool fits = number.kind == NumberKind::signed_integer
                        ? as_signed(number, bits) == value
                        : value >= 0 && bits << unused >> unused == bits;
  if (fits) std::memcpy(at, &bits, number.bytes());
  return fits;
}

uint64_t distance(const Number& number, const std::byte* a, const std::byte* b) {
  const uint64_t one = bits_at(number, a), other = bits_at(number, b);
  if (one == other) return 0;
  if (number.kind == NumberKind::unsigned_integer) return one > other ? one - other : other - one;
  if (number.kind == NumberKind::signed_integer) {
    const int64_t x = as_signed(number, one), y = as_signed(number, other);
    return x > y ? uint64_t(x) - uint64_t(y) : uint64_t(y) - uint64_t(x);
  }
  const bool nan = std::isnan(real_of(number, one)), other_nan = std::isnan(real_of(number, other));
  if (nan || other_nan) return nan && other_nan ? 0 : std::numeric_limits<uint64_t>::max();
  const int64_t x = ordered(number, one), y = ordered(number, other);
  const uint64_t apart = x > y ? uint64_t(x) - uint64_t(y) : uint64_t(y) - uint64_t(x);
  return apart == 0 ? 1 : apart;  // zeros of both signs
}

}  // namespace eyeray::engine::compute
