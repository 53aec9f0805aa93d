#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "host/emulator/columns.hpp"
#include "host/emulator/executes.hpp"

namespace eyeray::engine::emulator {
namespace {

// Division, remainders and shifts, where some operands have no result. `allows`: whether the second operand
// is allowed, given the first.
template <typename T, auto Allows, auto F>
void checked(Group& group, const Operation& o, const char* problem) {
  const uint32_t components = o.words / words_of<T>;
  for (uint32_t component = 0; component < components; ++component) {
    const Column<T> a = column<T>(group, o.from[0], component), b = column<T>(group, o.from[1], component);
    const Target<T> to = target<T>(group, o, component);
    group.each([&](uint32_t lane) {
      const Computed<T> x = a[lane], y = b[lane];
      const bool defined = Allows(x, y);
      to.set(lane, defined ? Computed<T>(F(x, y)) : 0);
      const uint32_t word = component * words_of<T>;
      if (!defined && !group.unset(o.from[0], word, lane) && !group.unset(o.from[1], word, lane))
        group.report(o, lane, Fault::undefined_integer, fmt::format("{} and {}: {}", x, y, problem));
    });
  }
  group.spread_unset(o, components);
}

template <typename T, auto F>
void divide(Group& group, const Operation& o) {
  constexpr auto allows = [](Computed<T> x, Computed<T> y) {
    return y != 0 && !(std::is_signed_v<T> && x == std::numeric_limits<T>::min() && y == Computed<T>(-1));
  };
  checked<T, allows, F>(group, o, "the quotient is undefined");
}
template <auto F>
Execute divide_naturals(uint32_t bits) {
  return bits == 8    ? divide<uint8_t, F>
         : bits == 16 ? divide<uint16_t, F>
         : bits == 64 ? divide<uint64_t, F>
                      : divide<uint32_t, F>;
}
template <auto F>
Execute divide_integers(uint32_t bits) {
  return bits == 8    ? divide<int8_t, F>
         : bits == 16 ? divide<int16_t, F>
         : bits == 64 ? divide<int64_t, F>
                      : divide<int32_t, F>;
}

// The numbers of bits to shift by may have another width. They are unsigned.
template <typename T, auto F>
void shift(Group& group, const Operation& o) {
  constexpr uint32_t bits = sizeof(T) * 8;
  const uint32_t components = o.words / words_of<T>, by_words = o.from[1].words / components;
  for (uint32_t component = 0; component < components; ++component) {
    const Column<T> a = column<T>(group, o.from[0], component);
    const Row by = group.read(o.from[1], component * by_words),
              high = group.read(o.from[1], component * by_words + by_words - 1);
    const Target<T> to = target<T>(group, o, component);
    group.each([&](uint32_t lane) {
      const bool defined = by[lane] < bits && (by_words == 1 || high[lane] == 0);
      to.set(lane, defined ? Computed<T>(F(a[lane], by[lane])) : 0);
      if (!defined && !group.unset(o.from[0], component * words_of<T>, lane) &&
          !group.unset(o.from[1], component * by_words, lane))
        group.report(o, lane, Fault::undefined_integer,
                     fmt::format("{} and {}: a shift by {} or more is undefined", a[lane], by[lane], bits));
    });
  }
  group.spread_unset(o, components);
}
template <bool Signed, auto F>
Execute shifts(uint32_t bits) {
  return bits == 8    ? shift<std::conditional_t<Signed, int8_t, uint8_t>, F>
         : bits == 16 ? shift<std::conditional_t<Signed, int16_t, uint16_t>, F>
         : bits == 64 ? shift<std::conditional_t<Signed, int64_t, uint64_t>, F>
                      : shift<std::conditional_t<Signed, int32_t, uint32_t>, F>;
}

// A bool chooses a component, or the whole value.
void select(Group& group, const Operation& o) {
  const uint32_t words = o.words / o.from[0].words;  // that a bool chooses
  for (uint32_t word = 0; word < o.words; ++word) {
    const uint32_t chooser = word / words;
    const Row condition = group.read(o.from[0], chooser);
    const Row a = group.read(o.from[1], word), b = group.read(o.from[2], word);
    uint32_t* to = group.row(o.to + word);
    group.each([&](uint32_t lane) { to[lane] = condition[lane] ? a[lane] : b[lane]; });
    // Only the chosen value counts.
    if (!group.any_unset(o.from[0]) && !group.any_unset(o.from[1]) && !group.any_unset(o.from[2]) &&
        !group.any_unset({.at = o.to, .words = o.words}))
      continue;
    group.each([&](uint32_t lane) {
      group.set_unset(
          o.to + word, lane,
          group.unset(o.from[0], chooser, lane) || group.unset(o.from[condition[lane] ? 1 : 2], word, lane));
    });
  }
}

template <bool Wanted>
void any_or_all(Group& group, const Operation& o) {
  uint32_t* to = group.row(o.to);
  group.each([&](uint32_t lane) {
    bool result = !Wanted;
    for (uint32_t word = 0; word < o.from[0].words; ++word)
      if ((group.read(o.from[0], word)[lane] != 0) == Wanted) result = Wanted;
    to[lane] = result;
  });
  group.spread_unset(o, 1);
}

constexpr auto bit_count = [](uint32_t x) { return uint32_t(std::popcount(x)); };
constexpr auto bit_reverse = [](uint32_t x) {
  uint32_t reversed = 0;
  for (int n = 0; n < 32; ++n) reversed |= (x >> n & 1u) << (31 - n);
  return reversed;
};

// o.from: base, [insert,] offset, count.
template <bool Inserts, bool Signed>
void bit_field(Group& group, const Operation& o) {
  const uint32_t components = o.words;
  for (uint32_t word = 0; word < components; ++word) {
    const Row base = group.read(o.from[0], word), insert = group.read(o.from[1], Inserts ? word : 0);
    const Row offset = group.read(o.from[Inserts ? 2 : 1], 0), count = group.read(o.from[Inserts ? 3 : 2], 0);
    uint32_t* to = group.row(o.to + word);
    group.each([&](uint32_t lane) {
      const uint64_t from = offset[lane], many = count[lane];
      if (from + many > 32) {
        to[lane] = 0;
        group.report(o, lane, Fault::undefined_integer,
                     fmt::format("bits {} to {} of 32", from, from + many));
        return;
      }
      const auto mask = uint32_t(((uint64_t{1} << many) - 1) << from);
      if (Inserts) {
        to[lane] = (base[lane] & ~mask) | (uint32_t(uint64_t{insert[lane]} << from) & mask);
      } else {
        const auto field = uint32_t((base[lane] & mask) >> from);
        const bool negative = Signed && many > 0 && (field >> (many - 1) & 1u);
        to[lane] = negative ? field | ~uint32_t((uint64_t{1} << many) - 1) : field;
      }
    });
  }
  group.spread_unset(o, components);
}

// The low and the high words of a product, one after the other.
template <typename T, typename Wide>
void multiply_extended(Group& group, const Operation& o) {
  const uint32_t components = o.words / 2;
  for (uint32_t word = 0; word < components; ++word) {
    const Row a = group.read(o.from[0], word), b = group.read(o.from[1], word);
    group.each([&](uint32_t lane) {
      const auto whole = uint64_t(Wide{std::bit_cast<T>(a[lane])} * Wide{std::bit_cast<T>(b[lane])});
      group.row(o.to + word)[lane] = uint32_t(whole);
      group.row(o.to + components + word)[lane] = uint32_t(whole >> 32);
    });
  }
  group.spread_unset(o, 1);
}

template <bool Adds>
void add_or_subtract_extended(Group& group, const Operation& o) {
  const uint32_t components = o.words / 2;
  for (uint32_t word = 0; word < components; ++word) {
    const Row a = group.read(o.from[0], word), b = group.read(o.from[1], word);
    group.each([&](uint32_t lane) {
      const uint32_t x = a[lane], y = b[lane];
      group.row(o.to + word)[lane] = Adds ? x + y : x - y;
      group.row(o.to + components + word)[lane] = Adds ? x + y < x : x < y;
    });
  }
  group.spread_unset(o, 1);
}

}  // namespace

void concatenate(Group& group, const Operation& o) {
  uint32_t at = o.to;
  for (const Source& source : o.from) {
    copy(group, at, source);
    at += source.words;
  }
}

void copy(Group& group, uint32_t at, const Source& source) {
  const bool marked = group.any_unset(source);
  for (uint32_t word = 0; word < source.words; ++word, ++at) {
    const Row from = group.read(source, word);
    uint32_t* to = group.row(at);
    if (!group.whole())
      group.each([&](uint32_t lane) { to[lane] = from[lane]; });
    else if (source.constant)
      std::fill_n(to, group.lanes(), from[0]);
    else
      std::copy_n(from.words, group.lanes(), to);
    if (marked || group.any_unset({.at = at, .words = 1}))
      group.each([&](uint32_t lane) { group.set_unset(at, lane, group.unset(source, word, lane)); });
  }
}

Execute arithmetic(spv::Op op, uint32_t bits) {
  switch (op) {
    case spv::OpFNegate:
      return reals<1, ([](auto x) { return -x; })>(bits);
    case spv::OpFAdd:
      return reals<2, ([](auto x, auto y) { return x + y; })>(bits);
    case spv::OpFSub:
      return reals<2, ([](auto x, auto y) { return x - y; })>(bits);
    case spv::OpFMul:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
      return reals<2, ([](auto x, auto y) { return x * y; })>(bits);
    case spv::OpFDiv:
      return reals<2, ([](auto x, auto y) { return x / y; })>(bits);
    case spv::OpFRem:
      return reals<2, ([](auto x, auto y) { return std::fmod(x, y); })>(bits);
    case spv::OpFMod:
      return reals<2, ([](auto x, auto y) { return x - y * std::floor(x / y); })>(bits);
    case spv::OpSNegate:
      return naturals<1, ([](auto x) { return 0u - x; })>(bits);
    case spv::OpIAdd:
      return naturals<2, ([](auto x, auto y) { return x + y; })>(bits);
    case spv::OpISub:
      return naturals<2, ([](auto x, auto y) { return x - y; })>(bits);
    case spv::OpIMul:
      return naturals<2, ([](auto x, auto y) { return x * y; })>(bits);
    case spv::OpUDiv:
      return divide_naturals<([](auto x, auto y) { return x / y; })>(bits);
    case spv::OpUMod:
      return divide_naturals<([](auto x, auto y) { return x % y; })>(bits);
    case spv::OpSDiv:
      return divide_integers<([](auto x, auto y) { return x / y; })>(bits);
    case spv::OpSRem:
      return divide_integers<([](auto x, auto y) { return x % y; })>(bits);
    case spv::OpSMod:
      return divide_integers<([](auto x, auto y) {
        const auto rest = x % y;
        return rest != 0 && (rest < 0) != (y < 0) ? rest + y : rest;
      })>(bits);
    case spv::OpUMulExtended:
      return bits == 32 ? multiply_extended<uint32_t, uint64_t> : nullptr;
    case spv::OpSMulExtended:
      return bits == 32 ? multiply_extended<int32_t, int64_t> : nullptr;
    case spv::OpIAddCarry:
      return bits == 32 ? add_or_subtract_extended<true> : nullptr;
    case spv::OpISubBorrow:
      return bits == 32 ? add_or_subtract_extended<false> : nullptr;
    case spv::OpShiftLeftLogical:
      return shifts<false, ([](auto x, uint32_t y) { return x << y; })>(bits);
    case spv::OpShiftRightLogical:
      return shifts<false, ([](auto x, uint32_t y) { return x >> y; })>(bits);
    case spv::OpShiftRightArithmetic:
      return shifts<true, ([](auto x, uint32_t y) { return x >> y; })>(bits);
    case spv::OpBitwiseAnd:
    case spv::OpLogicalAnd:
      return naturals<2, ([](auto x, auto y) { return x & y; })>(bits);
    case spv::OpBitwiseOr:
    case spv::OpLogicalOr:
      return naturals<2, ([](auto x, auto y) { return x | y; })>(bits);
    case spv::OpBitwiseXor:
    case spv::OpLogicalNotEqual:
      return naturals<2, ([](auto x, auto y) { return x ^ y; })>(bits);
    case spv::OpNot:
      return naturals<1, ([](auto x) { return ~x; })>(bits);
    case spv::OpBitCount:
      return bits == 32 ? map<uint32_t, uint32_t, 1, bit_count> : nullptr;
    case spv::OpBitReverse:
      return bits == 32 ? map<uint32_t, uint32_t, 1, bit_reverse> : nullptr;
    case spv::OpBitFieldInsert:
      return bits == 32 ? bit_field<true, false> : nullptr;
    case spv::OpBitFieldUExtract:
      return bits == 32 ? bit_field<false, false> : nullptr;
    case spv::OpBitFieldSExtract:
      return bits == 32 ? bit_field<false, true> : nullptr;
    case spv::OpSelect:
      return select;
    case spv::OpAny:
      return any_or_all<true>;
    case spv::OpAll:
      return any_or_all<false>;
    default:
      return nullptr;
  }
}

}  // namespace eyeray::engine::emulator
