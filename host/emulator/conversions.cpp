#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "host/emulator/columns.hpp"
#include "host/emulator/executes.hpp"

namespace eyeray::engine::emulator {
namespace {

template <typename To, typename From>
void convert(Group& group, const Operation& o) {
  constexpr auto f = [](Computed<From> x) { return Computed<To>(x); };
  map<To, From, 1, f>(group, o);
}
// A half is rounded once.
template <>
void convert<Half, double>(Group& group, const Operation& o) {
  const uint32_t components = o.words;
  for (uint32_t component = 0; component < components; ++component) {
    const Column<double> from = column<double>(group, o.from[0], component);
    uint32_t* to = group.row(o.to + component);
    group.each([&](uint32_t lane) { to[lane] = to_half(from[lane]); });
  }
  group.spread_unset(o, components);
}

// A float as a whole number.
template <typename To, typename From>
void to_whole(Group& group, const Operation& o) {
  using Limits = std::numeric_limits<To>;
  const uint32_t components = o.words / words_of<To>;
  const double end = std::ldexp(1.0, Limits::digits);
  for (uint32_t component = 0; component < components; ++component) {
    const Column<From> from = column<From>(group, o.from[0], component);
    const Target<To> to = target<To>(group, o, component);
    group.each([&](uint32_t lane) {
      const double x = std::trunc(double(from[lane]));
      const bool fits = x >= double(Limits::min()) && x < end;
      to.set(lane, fits ? Computed<To>(x) : 0);
      if (!fits && !group.unset(o.from[0], component * words_of<From>, lane))
        group.report(o, lane, Fault::undefined_integer,
                     fmt::format("{} is not within the integer's range", from[lane]));
    });
  }
  group.spread_unset(o, components);
}

template <typename From>
Execute from_natural(spv::Op op, uint32_t bits) {
  if (op == spv::OpConvertUToF)
    return bits == 16 ? convert<Half, From> : bits == 64 ? convert<double, From> : convert<float, From>;
  return bits == 8    ? convert<uint8_t, From>
         : bits == 16 ? convert<uint16_t, From>
         : bits == 64 ? convert<uint64_t, From>
                      : convert<uint32_t, From>;
}
template <typename From>
Execute from_integer(spv::Op op, uint32_t bits) {
  if (op == spv::OpConvertSToF)
    return bits == 16 ? convert<Half, From> : bits == 64 ? convert<double, From> : convert<float, From>;
  return bits == 8    ? convert<int8_t, From>
         : bits == 16 ? convert<int16_t, From>
         : bits == 64 ? convert<int64_t, From>
                      : convert<int32_t, From>;
}
template <typename From>
Execute from_real(spv::Op op, uint32_t bits) {
  if (op == spv::OpFConvert)
    return bits == 16 ? convert<Half, From> : bits == 64 ? convert<double, From> : convert<float, From>;
  if (op == spv::OpConvertFToU)
    return bits == 8    ? to_whole<uint8_t, From>
           : bits == 16 ? to_whole<uint16_t, From>
           : bits == 64 ? to_whole<uint64_t, From>
                        : to_whole<uint32_t, From>;
  return bits == 8    ? to_whole<int8_t, From>
         : bits == 16 ? to_whole<int16_t, From>
         : bits == 64 ? to_whole<int64_t, From>
                      : to_whole<int32_t, From>;
}

// A word of floats of `bits` bits, without the number of a birth, which a whole number cannot have.
uint32_t forget(uint32_t x, uint32_t bits, uint32_t word) {
  if (bits == 64 && word % 2 == 0) return x;
  return without_birth(x, bits);
}

// Bits of numbers of one width as those of another. o.literals: the bits of a number of the operand, and of
// the result, and whether the operand's are floats.
void split_or_join(Group& group, const Operation& o) {
  const auto words_each = [](uint32_t bits) { return bits == 64 ? 2u : 1u; };
  const uint32_t from = o.literals[0] / words_each(o.literals[0]),
                 to = o.literals[1] / words_each(o.literals[1]);
  group.each([&](uint32_t lane) {
    uint64_t all[4] = {};  // at most 256 bits
    uint32_t bit = 0;
    for (uint32_t word = 0; word < o.from[0].words; ++word, bit += from) {
      uint32_t x = group.read(o.from[0], word)[lane];
      if (o.literals[2]) x = forget(x, o.literals[0], word);
      all[bit / 64] |= uint64_t{x & uint32_t((uint64_t{1} << from) - 1)} << bit % 64;
    }
    bit = 0;
    for (uint32_t word = 0; word < o.words; ++word, bit += to)
      group.row(o.to + word)[lane] = uint32_t(all[bit / 64] >> bit % 64 & ((uint64_t{1} << to) - 1));
  });
  group.spread_unset(o, 1);
}

// Copies floats as whole numbers of the same width.
template <uint32_t Bits>
void forget_births(Group& group, const Operation& o) {
  for (uint32_t word = 0; word < o.words; ++word) {
    const Row from = group.read(o.from[0], word);
    uint32_t* to = group.row(o.to + word);
    group.each([&](uint32_t lane) { to[lane] = forget(from[lane], Bits, word); });
  }
  group.spread_unset(o, o.words);
}

}  // namespace

Execute conversion(spv::Op op, uint32_t from, uint32_t to) {
  switch (op) {
    case spv::OpQuantizeToF16:
      return reals<1, ([](auto x) { return half_to_float(to_half(double(x))); })>(from);
    case spv::OpUConvert:
    case spv::OpConvertUToF:
      return from == 8    ? from_natural<uint8_t>(op, to)
             : from == 16 ? from_natural<uint16_t>(op, to)
             : from == 64 ? from_natural<uint64_t>(op, to)
                          : from_natural<uint32_t>(op, to);
    case spv::OpSConvert:
    case spv::OpConvertSToF:
      return from == 8    ? from_integer<int8_t>(op, to)
             : from == 16 ? from_integer<int16_t>(op, to)
             : from == 64 ? from_integer<int64_t>(op, to)
                          : from_integer<int32_t>(op, to);
    case spv::OpFConvert:
    case spv::OpConvertFToU:
    case spv::OpConvertFToS:
      return from == 16   ? from_real<Half>(op, to)
             : from == 64 ? from_real<double>(op, to)
                          : from_real<float>(op, to);
    default:
      return nullptr;
  }
}

Execute bit_cast(uint32_t from, uint32_t to, bool forgets) {
  // Numbers of 64 bits are words, as those of 32.
  if (from != to && (from < 32 || to < 32)) return split_or_join;
  if (!forgets) return concatenate;
  return from == 16 ? forget_births<16> : from == 64 ? forget_births<64> : forget_births<32>;
}

}  // namespace eyeray::engine::emulator
