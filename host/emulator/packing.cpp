#include <algorithm>
#include <cmath>

#include <spirv/unified1/GLSL.std.450.h>

#include "host/emulator/bits.hpp"
#include "host/emulator/executes.hpp"
#include "host/emulator/group.hpp"

namespace eyeray::engine::emulator {
namespace {

template <uint32_t Count, uint32_t Bits, bool Signed>
void pack(Group& group, const Operation& o) {
  constexpr float scale = Signed ? float((1u << (Bits - 1)) - 1) : float((1ull << Bits) - 1);
  uint32_t* to = group.row(o.to);
  group.each([&](uint32_t lane) {
    uint32_t word = 0;
    for (uint32_t n = 0; n < Count; ++n) {
      const float x = number_of<float>(group.read(o.from[0], n)[lane]);
      const float clamped = std::isnan(x) ? 0.0f : std::clamp(x, Signed ? -1.0f : 0.0f, 1.0f);
      const auto whole = uint32_t(int32_t(std::nearbyint(clamped * scale)));
      word |= (whole & uint32_t((1ull << Bits) - 1)) << (n * Bits);
    }
    to[lane] = word;
  });
  group.spread_unset(o, 1);
}
template <uint32_t Bits, bool Signed>
void unpack(Group& group, const Operation& o) {
  constexpr float scale = Signed ? float((1u << (Bits - 1)) - 1) : float((1ull << Bits) - 1);
  for (uint32_t n = 0; n < o.words; ++n)
    group.each([&](uint32_t lane) {
      const uint32_t field = group.read(o.from[0], 0)[lane] << (32 - Bits - n * Bits);
      const float whole = Signed ? float(int32_t(field) >> (32 - Bits)) : float(field >> (32 - Bits));
      group.row(o.to + n)[lane] =
          std::bit_cast<uint32_t>(Signed ? std::max(whole / scale, -1.0f) : whole / scale);
    });
  group.spread_unset(o, 1);
}
void pack_half(Group& group, const Operation& o) {
  group.each([&](uint32_t lane) {
    group.row(o.to)[lane] = to_half(double(number_of<float>(group.read(o.from[0], 0)[lane]))) |
                            to_half(double(number_of<float>(group.read(o.from[0], 1)[lane]))) << 16;
  });
  group.spread_unset(o, 1);
}
void unpack_half(Group& group, const Operation& o) {
  for (uint32_t n = 0; n < 2; ++n)
    group.each([&](uint32_t lane) {
      group.row(o.to + n)[lane] =
          std::bit_cast<uint32_t>(half_to_float(group.read(o.from[0], 0)[lane] >> (16 * n) & 0xffffu));
    });
  group.spread_unset(o, 1);
}

}  // namespace

Execute packing_function(uint32_t function) {
  switch (function) {
    case GLSLstd450PackSnorm4x8:
      return pack<4, 8, true>;
    case GLSLstd450PackUnorm4x8:
      return pack<4, 8, false>;
    case GLSLstd450PackSnorm2x16:
      return pack<2, 16, true>;
    case GLSLstd450PackUnorm2x16:
      return pack<2, 16, false>;
    case GLSLstd450PackHalf2x16:
      return pack_half;
    case GLSLstd450UnpackSnorm4x8:
      return unpack<8, true>;
    case GLSLstd450UnpackUnorm4x8:
      return unpack<8, false>;
    case GLSLstd450UnpackSnorm2x16:
      return unpack<16, true>;
    case GLSLstd450UnpackUnorm2x16:
      return unpack<16, false>;
    case GLSLstd450UnpackHalf2x16:
      return unpack_half;
    case GLSLstd450PackDouble2x32:
      return concatenate;
    case GLSLstd450UnpackDouble2x32:
      return bit_cast(64, 32, true);
    default:
      return nullptr;
  }
}

}  // namespace eyeray::engine::emulator
