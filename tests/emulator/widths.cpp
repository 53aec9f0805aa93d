#include <cmath>

#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

const std::string types =
    "\n#extension GL_EXT_shader_explicit_arithmetic_types : require\n"
    "#extension GL_EXT_shader_8bit_storage : require\n#extension GL_EXT_shader_16bit_storage : require\n"
    "#extension GL_EXT_shader_atomic_int64 : require\n"
    "#extension GL_EXT_shader_subgroup_extended_types_int8 : require\n"
    "#extension GL_EXT_shader_subgroup_extended_types_int64 : require\n"
    "#extension GL_EXT_shader_subgroup_extended_types_float16 : require\n"
    "#extension GL_KHR_shader_subgroup_arithmetic : require\n#line 5\n";

Ran run_wide(const std::string& body, std::vector<uint32_t> data, const std::string& declarations = "",
             std::map<uint32_t, std::vector<uint32_t>> more = {}) {
  return run(body, std::move(data),
             {.local_size = 8, .declarations = types + declarations, .more = std::move(more)});
}

uint64_t both(const Ran& ran, size_t i) {
  return ran.data[2 * i] | uint64_t{ran.data[2 * i + 1]} << 32;
}

const std::vector<uint32_t> nothing(32);

}  // namespace

TEST_CASE("whole numbers of 8, 16 and 64 bits wrap, divide and shift as C++'s") {
  Ran ran = run_wide(
      "int8_t x = int8_t(int(i) * 37 - 100); data[i] = uint(int(x * int8_t(3))); "
      "data[8u + i] = uint(int(x / int8_t(7))); data[16u + i] = uint(int(x >> 2)); "
      "data[24u + i] = uint(uint8_t(x) >> uint8_t(1)) + uint(x < int8_t(0) ? 1000u : 0u);",
      nothing);
  CHECK(ran.found() == "");
  for (int i = 0; i < 8; ++i) {
    const auto x = int8_t(i * 37 - 100);
    CHECK(int32_t(ran.data[i]) == int8_t(x * 3));
    CHECK(int32_t(ran.data[8 + i]) == x / 7);
    CHECK(int32_t(ran.data[16 + i]) == x >> 2);
    CHECK(ran.data[24 + i] == (uint8_t(x) >> 1) + (x < 0 ? 1000u : 0u));
  }
  ran = run_wide("uint16_t x = uint16_t(i * 9000u); data[i] = uint(x * x) + (uint(~x) << 16);", nothing);
  for (uint32_t i = 0; i < 8; ++i)
    CHECK(ran.data[i] == (uint16_t(i * 9000) * uint32_t{uint16_t(i * 9000)} & 0xffffu) +
                             (uint32_t{uint16_t(~(i * 9000))} << 16));
  ran = run_wide(
      "int64_t x = int64_t(i) * 5000000000L - 9L; int64_t y = x / 7L * 3L ^ (x << (i * 5u)) ^ (x >> 3); "
      "if (x > 20000000000L) y = -y; data[2u * i] = uint(y); data[2u * i + 1u] = uint(uint64_t(y) >> 32);",
      nothing);
  CHECK(ran.found() == "");
  for (int i = 0; i < 8; ++i) {
    const int64_t x = int64_t{i} * 5000000000 - 9;
    const int64_t y = (x / 7 * 3) ^ int64_t(uint64_t(x) << (i * 5)) ^ (x >> 3);
    CHECK(int64_t(both(ran, size_t(i))) == (x > 20000000000 ? -y : y));
  }
}

TEST_CASE("a float of 16 bits is rounded to the nearest, once") {
  const auto half = [](const std::string& expression) {
    return run_wide("float16_t one = float16_t(1) + float16_t(i); float16_t x = " + expression +
                        "; data[i] = uint(float16BitsToUint16(x));",
                    nothing)
        .data[0];
  };
  CHECK(half("one / float16_t(3)") == 0x3555);
  CHECK(half("one * float16_t(2048) + one") == 0x6800);  // ties, to the even one
  CHECK(half("one * float16_t(2048) + one * float16_t(3)") == 0x6802);
  CHECK(half("one * float16_t(65504) + one * float16_t(16)") == 0x7c00);
  CHECK(half("-one * float16_t(65504) - one") == 0xfbff);
  CHECK(half("float16_t(6.0e-8LF * double(one))") == 0x0001);
  CHECK(half("sqrt(one + one)") == 0x3da8);
  CHECK(half("max(one, float16_t(1.5)) + f16vec2(one, 2).y") == 0x4300);
  CHECK(half("dot(f16vec3(one), f16vec3(1, 2, 3))") == 0x4600);
  CHECK(half("float16_t(int64_t(one) * 100000L)") == 0x7c00);
  CHECK(half("subgroupAdd(float16_t(0.5))") == 0x4400);
}

TEST_CASE("floats of 64 bits are computed as C++'s double") {
  const Ran ran = run_wide(
      "double x = double(i) / 3.0LF; double y = sqrt(x) * 7.0LF - floor(x) + fma(x, x, -1.0LF) + "
      "length(dvec3(x, 1.0LF, 2.0LF)) + min(x, 1.0LF); dmat2 m = dmat2(1.0LF, 2.0LF, 3.0LF, x); "
      "y += (m * dvec2(x, 1.0LF)).y; data[2u * i] = unpackDouble2x32(y).x; "
      "data[2u * i + 1u] = unpackDouble2x32(y).y;",
      nothing);
  CHECK(ran.found() == "");
  for (int i = 0; i < 8; ++i) {
    const double x = i / 3.0;
    const double y = std::sqrt(x) * 7 - std::floor(x) + (x * x + -1.0) + std::sqrt(x * x + 1 + 4) +
                     std::min(x, 1.0) + (2 * x + x * 1);
    CHECK(std::bit_cast<double>(both(ran, size_t(i))) == y);
  }
}

TEST_CASE("numbers are converted between widths, and their bits split and joined") {
  const Ran ran = run_wide(
      "data[i] = uint(int(int8_t(float(i) * -12.75))); data[8u + i] = floatBitsToUint(float(double(i) * "
      "1.1LF)); data[16u + i] = pack32(u8vec4(i, 2, 3, 255)); "
      "data[24u + i] = uint(unpack8(data[16u + i]).w) + uint(unpack16(uint64_t(i) << 48).w);",
      nothing);
  CHECK(ran.found() == "");
  for (uint32_t i = 0; i < 8; ++i) {
    CHECK(int32_t(ran.data[i]) == int32_t(float(i) * -12.75f));
    CHECK(ran.real(8 + i) == float(double(i) * 1.1));
    CHECK(ran.data[16 + i] == (i | 0xff030200u));
    CHECK(ran.data[24 + i] == 255 + i);
  }
}

TEST_CASE("buffers hold numbers of 8, 16 and 64 bits") {
  const std::string declarations =
      "layout(std430, binding = 1) buffer Bytes { uint8_t bytes[16]; int16_t shorts[8]; uint64_t longs[]; };";
  std::map<uint32_t, std::vector<uint32_t>> more{{1, std::vector<uint32_t>(8 + 8)}};
  more[1][0] = 0x04030201;
  more[1][4] = 0xfffe0007;
  more[1][8] = 5, more[1][9] = 1;
  const Ran ran = run_wide(
      "bytes[i + 4u] = uint8_t(bytes[i % 4u] + uint8_t(254)); data[i] = uint(bytes[i + 4u]); "
      "data[8u + i] = uint(int(shorts[i % 2u])); "
      "if (i < 3u) longs[i + 1u] = longs[0] + uint64_t(i); "
      "if (i < 3u) data[16u + i] = uint(longs[i + 1u]) + uint(longs[i + 1u] >> 32); "
      "data[24u + i] = uint(longs.length());",
      nothing, declarations, more);
  CHECK(ran.found() == "");
  for (uint32_t i = 0; i < 8; ++i) {
    CHECK(ran.data[i] == (i % 4 + 255) % 256);
    CHECK(int32_t(ran.data[8 + i]) == (i % 2 ? -2 : 7));
    if (i < 3) CHECK(ran.data[16 + i] == 6 + i);
    CHECK(ran.data[24 + i] == 4);
  }
  // Invocations may write bytes of the same word, but not the same byte.
  CHECK(run_wide("bytes[i] = uint8_t(i);", nothing, declarations, more).found() == "");
  CHECK(run_wide("bytes[i / 2u] = uint8_t(i);", nothing, declarations, more).found().find("race") !=
        std::string::npos);
}

TEST_CASE("atomics may have 64 bits, and indices 16") {
  const Ran ran = run_wide(
      "atomicAdd(sum, uint64_t(i) << 30); list[i] = i; barrier(); if (i == 0u) { data[0] = "
      "uint(sum); data[1] = uint(sum >> 32); } data[2u + i] = list[uint16_t(7u - i)];",
      nothing, "layout(binding = 1) buffer Sum { uint64_t sum; }; shared uint list[8];",
      {{1, std::vector<uint32_t>(2)}});
  CHECK(both(ran, 0) == 28ull << 30);
  for (uint32_t i = 0; i < 8; ++i) CHECK(ran.data[2 + i] == 7 - i);
}
