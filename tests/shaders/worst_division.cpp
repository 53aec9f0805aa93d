// Division and square root that are corrected (shaders/math/exact.glsl), from a device's results as wrong as
// Vulkan allows.
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

#include "host/core/parallel_for.hpp"
#include "tests/support/amount.hpp"

namespace {

// The error of the device's results, in units in the last place. They are of numbers between 2^-25 and 4, far
// from infinities.
thread_local int units = 0;
float off(float exact) {
  return std::bit_cast<float>(std::bit_cast<uint32_t>(exact) + uint32_t(units));
}

}  // namespace

#define DEVICE_QUOTIENT(a, b) off((a) / (b))
#define DEVICE_ROOT(a) off(std::sqrt(a))
#include "shaders/math/exact.glsl"
#include "tests/support/doctest.hpp"

using namespace eyeray::engine;

namespace {

// The bits of a float, those of one NaN for all.
uint32_t bits(float x) {
  return std::isnan(x) ? 0xffc00000u : std::bit_cast<uint32_t>(x);
}

uint32_t mixed(uint64_t x) {
  x = (x ^ x >> 31) * 0x9e3779b97f4a7c15u;
  return uint32_t((x ^ x >> 29) * 0xbf58476d1ce4e5b9u >> 32);
}

// A pair of operands of one of eight kinds: any, near one, subnormal, huge and tiny, and quotients near the
// middle between two floats.
std::pair<float, float> operands(uint64_t i) {
  uint32_t a = mixed(2 * i), b = mixed(2 * i + 1);
  switch (i % 8) {
    case 1:
      a = (a & 0x807fffffu) | (b & 0x7f800000u);
      break;
    case 2:
      a &= 0x80ffffffu;
      break;
    case 3:
      b &= 0x80ffffffu;
      break;
    case 4:
      a &= 0x81ffffffu;
      b = (b & 0x807fffffu) | 0x7e800000u;
      break;
    case 5: {  // k / 2 · b, rounded, with k odd and of 25 bits
      const double k = double((a & 0x00ffffffu) | 0x01000001u);
      const float divisor = std::bit_cast<float>((b & 0x807fffffu) | 0x3f800000u);
      return {float(k * double(divisor) * 0x1p-25), divisor};
    }
    case 6: {  // the same with a subnormal quotient
      const double k = double((a & 0x000fffffu) | 1u);
      const float divisor = std::bit_cast<float>((b & 0x807fffffu) | 0x3f800000u);
      return {float(k * double(divisor) * 0x1p-150), divisor};
    }
    case 7:
      b = (b & 0xff800000u) | (b & 0xffu);
      break;
    default:
      break;
  }
  return {std::bit_cast<float>(a), std::bit_cast<float>(b)};
}

}  // namespace

TEST_CASE("corrected quotients are correctly rounded") {
  constexpr int parts = 64;
  const int64_t each = test::amount(10'000, 100'000, 4'000'000);
  std::atomic<int64_t> wrong = 0;
  parallel_for(0, parts, [&](int part) {
    for (int64_t i = 0; i < each; ++i) {
      const uint64_t number = uint64_t(part) * uint64_t(each) + uint64_t(i);
      const auto [a, b] = operands(number);
      units = int(mixed(~number) % 5) - 2;
      if (bits(shader::exact_quotient(a, b)) == bits(a / b)) continue;
      if (wrong++ < 3) FAIL_CHECK(a, " / ", b, ", off by ", units);
    }
  });
  CHECK(wrong == 0);
}

TEST_CASE("corrected quotients of zeros, infinities and NaN are those of IEEE 754") {
  const float special[] = {0.0f, -0.0f, 1.0f, -1.0f, 1e-45f, 3.4028235e38f, INFINITY, -INFINITY, NAN};
  for (const float a : special) {
    for (const float b : special) {
      CAPTURE(a);
      CAPTURE(b);
      CHECK(bits(shader::exact_quotient(a, b)) == bits(a / b));
    }
    CHECK(bits(shader::exact_root(a)) == bits(std::sqrt(a)));
  }
}

TEST_CASE("corrected roots are correctly rounded") {
  // Every float with EYERAY_FULL_TESTS=1, else one in so many.
  const uint32_t step = uint32_t(test::amount(9973, 997, 1));
  constexpr uint32_t parts = 256, of_a_part = 0x80000000u / parts;
  std::atomic<int64_t> wrong = 0;
  parallel_for(0, int(parts), [&](int part) {
    const uint32_t first = uint32_t(part) * of_a_part;
    for (uint32_t i = 0; i < of_a_part; i += step) {
      const float a = std::bit_cast<float>(first + i);
      units = int(mixed(first + i) % 13) - 6;  // Vulkan gives a root the error of 1 / inversesqrt(x)
      if (bits(shader::exact_root(a)) == bits(std::sqrt(a))) continue;
      if (wrong++ < 3) FAIL_CHECK("the root of ", a, ", off by ", units);
    }
  });
  CHECK(wrong == 0);
}
