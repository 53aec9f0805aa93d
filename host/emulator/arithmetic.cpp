#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "host/emulator/bits.hpp"
#include "host/emulator/executes.hpp"
#include "host/emulator/group.hpp"

namespace eyeray::engine::emulator {
namespace {

// F of the words of one, two or three operands, word by word. A single word stands for every word of the
// result.
template <typename T, auto F>
void unary(Group& group, const Operation& o) {
  for (uint32_t word = 0; word < o.words; ++word) {
    const Row a = group.read(o.from[0], word);
    uint32_t* to = group.row(o.to + word);
    group.each([&](uint32_t lane) { to[lane] = bits(F(as<T>(a[lane]))); });
  }
  group.spread_unset(o);
}

template <typename T, auto F>
void binary(Group& group, const Operation& o) {
  for (uint32_t word = 0; word < o.words; ++word) {
    const Row a = group.read(o.from[0], word), b = group.read(o.from[1], o.from[1].words == 1 ? 0 : word);
    uint32_t* to = group.row(o.to + word);
    group.each([&](uint32_t lane) { to[lane] = bits(F(as<T>(a[lane]), as<T>(b[lane]))); });
  }
  group.spread_unset(o);
}

// Division, remainders and shifts, where some operands have no result. `allows`: whether the second operand
// is allowed, given the first.
template <typename T, auto Allows, auto F>
void checked(Group& group, const Operation& o, const char* problem) {
  for (uint32_t word = 0; word < o.words; ++word) {
    const Row a = group.read(o.from[0], word), b = group.read(o.from[1], word);
    uint32_t* to = group.row(o.to + word);
    group.each([&](uint32_t lane) {
      const T x = as<T>(a[lane]), y = as<T>(b[lane]);
      const bool defined = Allows(x, y);
      to[lane] = defined ? bits(F(x, y)) : 0;
      if (!defined && !group.unset(o.from[0], word, lane) && !group.unset(o.from[1], word, lane))
        group.report(o, lane, Fault::undefined_integer, fmt::format("{} and {}: {}", x, y, problem));
    });
  }
  group.spread_unset(o);
}

template <typename T, auto F>
void divide(Group& group, const Operation& o) {
  constexpr auto allows = [](T x, T y) {
    return y != 0 && !(std::is_signed_v<T> && x == std::numeric_limits<T>::min() && y == T(-1));
  };
  checked<T, allows, F>(group, o, "the quotient is undefined");
}

template <auto F>
void shift(Group& group, const Operation& o) {
  constexpr auto allows = [](uint32_t, uint32_t y) { return y < 32; };
  checked<uint32_t, allows, F>(group, o, "a shift by 32 or more is undefined");
}

// A float as a whole number of type T.
template <typename T>
void to_whole(Group& group, const Operation& o) {
  for (uint32_t word = 0; word < o.words; ++word) {
    const Row a = group.read(o.from[0], word);
    uint32_t* to = group.row(o.to + word);
    group.each([&](uint32_t lane) {
      const double x = std::trunc(double(as<float>(a[lane])));
      const bool fits =
          x >= double(std::numeric_limits<T>::min()) && x <= double(std::numeric_limits<T>::max());
      to[lane] = fits ? bits(T(x)) : 0;
      if (!fits && !group.unset(o.from[0], word, lane))
        group.report(o, lane, Fault::undefined_integer,
                     fmt::format("{} is not within the integer's range", as<float>(a[lane])));
    });
  }
  group.spread_unset(o);
}

void select(Group& group, const Operation& o) {
  for (uint32_t word = 0; word < o.words; ++word) {
    const uint32_t chooser = o.from[0].words == 1 ? 0 : word;
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
  group.spread_unset(o);
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
  for (uint32_t word = 0; word < o.words; ++word) {
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
  group.spread_unset(o);
}

// The low and the high words of a product, one after the other.
template <typename T, typename Wide>
void multiply_extended(Group& group, const Operation& o) {
  const uint32_t words = o.words / 2;
  for (uint32_t word = 0; word < words; ++word) {
    const Row a = group.read(o.from[0], word), b = group.read(o.from[1], word);
    group.each([&](uint32_t lane) {
      const auto whole = uint64_t(Wide{as<T>(a[lane])} * Wide{as<T>(b[lane])});
      group.row(o.to + word)[lane] = uint32_t(whole);
      group.row(o.to + words + word)[lane] = uint32_t(whole >> 32);
    });
  }
  group.spread_unset(o);
}

template <bool Adds>
void add_or_subtract_extended(Group& group, const Operation& o) {
  const uint32_t words = o.words / 2;
  for (uint32_t word = 0; word < words; ++word) {
    const Row a = group.read(o.from[0], word), b = group.read(o.from[1], word);
    group.each([&](uint32_t lane) {
      const uint32_t x = a[lane], y = b[lane];
      group.row(o.to + word)[lane] = Adds ? x + y : x - y;
      group.row(o.to + words + word)[lane] = Adds ? x + y < x : x < y;
    });
  }
  group.spread_unset(o);
}

}  // namespace

void concatenate(Group& group, const Operation& o) {
  uint32_t at = o.to;
  for (const Source& source : o.from) {
    for (uint32_t word = 0; word < source.words; ++word, ++at) {
      const Row from = group.read(source, word);
      uint32_t* to = group.row(at);
      group.each([&](uint32_t lane) { to[lane] = from[lane]; });
      if (group.any_unset({.at = at, .words = 1}) || group.any_unset(source))
        group.each([&](uint32_t lane) { group.set_unset(at, lane, group.unset(source, word, lane)); });
    }
  }
}

Execute arithmetic(spv::Op op) {
  using U = uint32_t;
  using S = int32_t;
  using F = float;
  switch (op) {
    case spv::OpBitcast:
      return concatenate;
    case spv::OpFNegate:
      return unary<F, ([](F x) { return -x; })>;
    case spv::OpFAdd:
      return binary<F, ([](F x, F y) { return x + y; })>;
    case spv::OpFSub:
      return binary<F, ([](F x, F y) { return x - y; })>;
    case spv::OpFMul:
    case spv::OpVectorTimesScalar:
    case spv::OpMatrixTimesScalar:
      return binary<F, ([](F x, F y) { return x * y; })>;
    case spv::OpFDiv:
      return binary<F, ([](F x, F y) { return x / y; })>;
    case spv::OpFRem:
      return binary<F, ([](F x, F y) { return std::fmod(x, y); })>;
    case spv::OpFMod:
      return binary<F, ([](F x, F y) { return x - y * std::floor(x / y); })>;
    case spv::OpSNegate:
      return unary<U, ([](U x) { return 0u - x; })>;
    case spv::OpIAdd:
      return binary<U, ([](U x, U y) { return x + y; })>;
    case spv::OpISub:
      return binary<U, ([](U x, U y) { return x - y; })>;
    case spv::OpIMul:
      return binary<U, ([](U x, U y) { return x * y; })>;
    case spv::OpUDiv:
      return divide<U, ([](U x, U y) { return x / y; })>;
    case spv::OpUMod:
      return divide<U, ([](U x, U y) { return x % y; })>;
    case spv::OpSDiv:
      return divide<S, ([](S x, S y) { return x / y; })>;
    case spv::OpSRem:
      return divide<S, ([](S x, S y) { return x % y; })>;
    case spv::OpSMod:
      return divide<S, ([](S x, S y) {
                      const S rest = x % y;
                      return rest != 0 && (rest < 0) != (y < 0) ? rest + y : rest;
                    })>;
    case spv::OpUMulExtended:
      return multiply_extended<U, uint64_t>;
    case spv::OpSMulExtended:
      return multiply_extended<S, int64_t>;
    case spv::OpIAddCarry:
      return add_or_subtract_extended<true>;
    case spv::OpISubBorrow:
      return add_or_subtract_extended<false>;
    case spv::OpShiftLeftLogical:
      return shift<([](U x, U y) { return x << y; })>;
    case spv::OpShiftRightLogical:
      return shift<([](U x, U y) { return x >> y; })>;
    case spv::OpShiftRightArithmetic:
      return shift<([](U x, U y) { return S(x) >> y; })>;
    case spv::OpBitwiseAnd:
    case spv::OpLogicalAnd:
      return binary<U, ([](U x, U y) { return x & y; })>;
    case spv::OpBitwiseOr:
    case spv::OpLogicalOr:
      return binary<U, ([](U x, U y) { return x | y; })>;
    case spv::OpBitwiseXor:
    case spv::OpLogicalNotEqual:
      return binary<U, ([](U x, U y) { return x ^ y; })>;
    case spv::OpNot:
      return unary<U, ([](U x) { return ~x; })>;
    case spv::OpBitCount:
      return unary<U, bit_count>;
    case spv::OpBitReverse:
      return unary<U, bit_reverse>;
    case spv::OpBitFieldInsert:
      return bit_field<true, false>;
    case spv::OpBitFieldUExtract:
      return bit_field<false, false>;
    case spv::OpBitFieldSExtract:
      return bit_field<false, true>;
    case spv::OpLogicalNot:
      return unary<U, ([](U x) { return x ^ 1u; })>;
    case spv::OpIEqual:
    case spv::OpLogicalEqual:
      return binary<U, ([](U x, U y) { return x == y; })>;
    case spv::OpINotEqual:
      return binary<U, ([](U x, U y) { return x != y; })>;
    case spv::OpULessThan:
      return binary<U, ([](U x, U y) { return x < y; })>;
    case spv::OpULessThanEqual:
      return binary<U, ([](U x, U y) { return x <= y; })>;
    case spv::OpUGreaterThan:
      return binary<U, ([](U x, U y) { return x > y; })>;
    case spv::OpUGreaterThanEqual:
      return binary<U, ([](U x, U y) { return x >= y; })>;
    case spv::OpSLessThan:
      return binary<S, ([](S x, S y) { return x < y; })>;
    case spv::OpSLessThanEqual:
      return binary<S, ([](S x, S y) { return x <= y; })>;
    case spv::OpSGreaterThan:
      return binary<S, ([](S x, S y) { return x > y; })>;
    case spv::OpSGreaterThanEqual:
      return binary<S, ([](S x, S y) { return x >= y; })>;
    case spv::OpFOrdEqual:
      return binary<F, ([](F x, F y) { return x == y; })>;
    case spv::OpFUnordEqual:
      return binary<F, ([](F x, F y) { return !(x < y || x > y); })>;
    case spv::OpFOrdNotEqual:
      return binary<F, ([](F x, F y) { return x < y || x > y; })>;
    case spv::OpFUnordNotEqual:
      return binary<F, ([](F x, F y) { return x != y; })>;
    case spv::OpFOrdLessThan:
      return binary<F, ([](F x, F y) { return x < y; })>;
    case spv::OpFOrdLessThanEqual:
      return binary<F, ([](F x, F y) { return x <= y; })>;
    case spv::OpFOrdGreaterThan:
      return binary<F, ([](F x, F y) { return x > y; })>;
    case spv::OpFOrdGreaterThanEqual:
      return binary<F, ([](F x, F y) { return x >= y; })>;
    case spv::OpFUnordLessThan:
      return binary<F, ([](F x, F y) { return !(x >= y); })>;
    case spv::OpFUnordLessThanEqual:
      return binary<F, ([](F x, F y) { return !(x > y); })>;
    case spv::OpFUnordGreaterThan:
      return binary<F, ([](F x, F y) { return !(x <= y); })>;
    case spv::OpFUnordGreaterThanEqual:
      return binary<F, ([](F x, F y) { return !(x < y); })>;
    case spv::OpIsNan:
      return unary<F, ([](F x) { return std::isnan(x); })>;
    case spv::OpIsInf:
      return unary<F, ([](F x) { return std::isinf(x); })>;
    case spv::OpConvertFToU:
      return to_whole<U>;
    case spv::OpConvertFToS:
      return to_whole<S>;
    case spv::OpConvertUToF:
      return unary<U, ([](U x) { return F(x); })>;
    case spv::OpConvertSToF:
      return unary<S, ([](S x) { return F(x); })>;
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
