#include <cmath>

#include <spirv/unified1/GLSL.std.450.h>

#include "host/emulator/bits.hpp"
#include "host/emulator/executes.hpp"
#include "host/emulator/group.hpp"

namespace eyeray::engine::emulator {
namespace {

// F of the words of N operands, word by word.
template <typename T, size_t N, auto F>
void per_word(Group& group, const Operation& o) {
  for (uint32_t word = 0; word < o.words; ++word) {
    Row rows[N];
    for (size_t n = 0; n < N; ++n) rows[n] = group.read(o.from[n], word);
    uint32_t* to = group.row(o.to + word);
    group.each([&](uint32_t lane) {
      if constexpr (N == 1) to[lane] = bits(F(as<T>(rows[0][lane])));
      if constexpr (N == 2) to[lane] = bits(F(as<T>(rows[0][lane]), as<T>(rows[1][lane])));
      if constexpr (N == 3)
        to[lane] = bits(F(as<T>(rows[0][lane]), as<T>(rows[1][lane]), as<T>(rows[2][lane])));
    });
  }
  group.spread_unset(o);
}

// F(a, b, result) of whole vectors, where the second operand may be missing.
template <auto F>
void of_vectors(Group& group, const Operation& o) {
  group.each([&](uint32_t lane) {
    float numbers[4][16] = {};
    for (size_t n = 0; n < o.from.size(); ++n)
      for (uint32_t word = 0; word < o.from[n].words; ++word)
        numbers[n][word] = as<float>(group.read(o.from[n], word)[lane]);
    float result[16] = {};
    F(numbers, o.from[0].words, result);
    for (uint32_t word = 0; word < o.words; ++word) group.row(o.to + word)[lane] = bits(result[word]);
  });
  // Each number of the result depends on all.
  Operation all = o;
  for (Source& source : all.from)
    if (group.any_unset(source)) {
      for (uint32_t word = 0; word < source.words; ++word)
        for (const uint32_t lane : group.active())
          if (group.unset(source, word, lane))
            for (uint32_t to = 0; to < o.words; ++to) group.set_unset(o.to + to, lane, true);
      return;
    }
  group.spread_unset(o);
}

using F = float;
using U = uint32_t;
using S = int32_t;
using Vectors = float (&)[4][16];

float dot_product(const float* a, const float* b, uint32_t size) {
  float sum = a[0] * b[0];
  for (uint32_t n = 1; n < size; ++n) sum += a[n] * b[n];
  return sum;
}

constexpr auto least = [](F x, F y) { return y < x ? y : x; };
constexpr auto greatest = [](F x, F y) { return x < y ? y : x; };

// The minor without row and column, of a matrix in columns.
float determinant(const float* m, uint32_t size) {
  if (size == 1) return m[0];
  float sum = 0;
  for (uint32_t column = 0; column < size; ++column) {
    float minor[9] = {};
    uint32_t at = 0;
    for (uint32_t c = 0; c < size; ++c)
      for (uint32_t r = 1; c != column && r < size; ++r) minor[at++] = m[c * size + r];
    sum += (column % 2 ? -1.0f : 1.0f) * m[column * size] * determinant(minor, size - 1);
  }
  return sum;
}

float half_to_float(uint32_t half) {
  const uint32_t sign = half >> 15 & 1u, exponent = half >> 10 & 31u, fraction = half & 1023u;
  const float magnitude = exponent == 0    ? std::ldexp(float(fraction), -24)
                          : exponent == 31 ? (fraction ? NAN : INFINITY)
                                           : std::ldexp(float(fraction + 1024), int(exponent) - 25);
  return sign ? -magnitude : magnitude;
}
// To the nearest half, halfway cases to the even one.
uint32_t float_to_half(float x) {
  const uint32_t sign = std::signbit(x) ? 0x8000u : 0u;
  const double magnitude = std::fabs(double(x));
  if (std::isnan(x)) return sign | 0x7e00u;
  if (magnitude >= 65520) return sign | 0x7c00u;
  int exponent = 0;
  std::frexp(magnitude, &exponent);
  const int step = std::max(exponent - 11, -24);
  const auto steps = uint32_t(std::nearbyint(std::ldexp(magnitude, -step)));
  return sign | (steps < 1024 ? steps : uint32_t(step + 24) * 1024u + steps);
}

template <uint32_t Count, uint32_t Bits, bool Signed>
void pack(Group& group, const Operation& o) {
  constexpr float scale = Signed ? float((1u << (Bits - 1)) - 1) : float((1ull << Bits) - 1);
  uint32_t* to = group.row(o.to);
  group.each([&](uint32_t lane) {
    uint32_t word = 0;
    for (uint32_t n = 0; n < Count; ++n) {
      const float x = as<float>(group.read(o.from[0], n)[lane]);
      const float clamped = std::isnan(x) ? 0.0f : std::clamp(x, Signed ? -1.0f : 0.0f, 1.0f);
      const auto whole = uint32_t(int32_t(std::nearbyint(clamped * scale)));
      word |= (whole & uint32_t((1ull << Bits) - 1)) << (n * Bits);
    }
    to[lane] = word;
  });
  group.spread_unset(o);
}
template <uint32_t Bits, bool Signed>
void unpack(Group& group, const Operation& o) {
  constexpr float scale = Signed ? float((1u << (Bits - 1)) - 1) : float((1ull << Bits) - 1);
  for (uint32_t n = 0; n < o.words; ++n)
    group.each([&](uint32_t lane) {
      const uint32_t field = group.read(o.from[0], 0)[lane] << (32 - Bits - n * Bits);
      const float whole = Signed ? float(S(field) >> (32 - Bits)) : float(field >> (32 - Bits));
      group.row(o.to + n)[lane] = bits(Signed ? std::max(whole / scale, -1.0f) : whole / scale);
    });
  group.spread_unset(o);
}
void pack_half(Group& group, const Operation& o) {
  group.each([&](uint32_t lane) {
    group.row(o.to)[lane] = float_to_half(as<F>(group.read(o.from[0], 0)[lane])) |
                            float_to_half(as<F>(group.read(o.from[0], 1)[lane])) << 16;
  });
  group.spread_unset(o);
}
void unpack_half(Group& group, const Operation& o) {
  for (uint32_t n = 0; n < 2; ++n)
    group.each([&](uint32_t lane) {
      group.row(o.to + n)[lane] = bits(half_to_float(group.read(o.from[0], 0)[lane] >> (16 * n) & 0xffffu));
    });
  group.spread_unset(o);
}

Execute common_function(uint32_t function) {
  switch (function) {
    case GLSLstd450Round:
    case GLSLstd450RoundEven:
      return per_word<F, 1, ([](F x) { return std::nearbyint(x); })>;
    case GLSLstd450Trunc:
      return per_word<F, 1, ([](F x) { return std::trunc(x); })>;
    case GLSLstd450FAbs:
      return per_word<F, 1, ([](F x) { return std::fabs(x); })>;
    case GLSLstd450SAbs:
      return per_word<S, 1, ([](S x) { return x < 0 ? 0u - U(x) : U(x); })>;
    case GLSLstd450FSign:
      return per_word<F, 1, ([](F x) { return x > 0 ? 1.0f : x < 0 ? -1.0f : x; })>;
    case GLSLstd450SSign:
      return per_word<S, 1, ([](S x) { return S(x > 0) - S(x < 0); })>;
    case GLSLstd450Floor:
      return per_word<F, 1, ([](F x) { return std::floor(x); })>;
    case GLSLstd450Ceil:
      return per_word<F, 1, ([](F x) { return std::ceil(x); })>;
    case GLSLstd450Fract:
      return per_word<F, 1, ([](F x) { return x - std::floor(x); })>;
    case GLSLstd450FMin:
    case GLSLstd450NMin:
      return per_word<F, 2, ([](F x, F y) { return std::isnan(x) ? y : std::isnan(y) ? x : least(x, y); })>;
    case GLSLstd450FMax:
    case GLSLstd450NMax:
      return per_word<F, 2, ([](F x, F y) {
                        return std::isnan(x) ? y : std::isnan(y) ? x : greatest(x, y);
                      })>;
    case GLSLstd450UMin:
      return per_word<U, 2, ([](U x, U y) { return x < y ? x : y; })>;
    case GLSLstd450UMax:
      return per_word<U, 2, ([](U x, U y) { return x < y ? y : x; })>;
    case GLSLstd450SMin:
      return per_word<S, 2, ([](S x, S y) { return x < y ? x : y; })>;
    case GLSLstd450SMax:
      return per_word<S, 2, ([](S x, S y) { return x < y ? y : x; })>;
    case GLSLstd450FClamp:
    case GLSLstd450NClamp:
      return per_word<F, 3, ([](F x, F low, F high) {
                        return least(std::isnan(x) ? low : greatest(x, low), high);
                      })>;
    case GLSLstd450UClamp:
      return per_word<U, 3, ([](U x, U low, U high) { return x < low ? low : x > high ? high : x; })>;
    case GLSLstd450SClamp:
      return per_word<S, 3, ([](S x, S low, S high) { return x < low ? low : x > high ? high : x; })>;
    case GLSLstd450FMix:
      return per_word<F, 3, ([](F x, F y, F a) { return x * (1 - a) + y * a; })>;
    case GLSLstd450Step:
      return per_word<F, 2, ([](F edge, F x) { return x < edge ? 0.0f : 1.0f; })>;
    case GLSLstd450SmoothStep:
      return per_word<F, 3, ([](F low, F high, F x) {
                        const F t = least(greatest((x - low) / (high - low), 0.0f), 1.0f);
                        return t * t * (3 - 2 * t);
                      })>;
    case GLSLstd450Fma:
      return per_word<F, 3, ([](F x, F y, F z) { return x * y + z; })>;
    case GLSLstd450FindILsb:
      return per_word<U, 1, ([](U x) { return x ? S(std::countr_zero(x)) : -1; })>;
    case GLSLstd450FindUMsb:
      return per_word<U, 1, ([](U x) { return 31 - S(std::countl_zero(x)); })>;
    case GLSLstd450FindSMsb:
      return per_word<S, 1, ([](S x) { return 31 - S(std::countl_zero(U(x < 0 ? ~x : x))); })>;
    default:
      return nullptr;
  }
}

Execute exponential_function(uint32_t function) {
  switch (function) {
    case GLSLstd450Radians:
      return per_word<F, 1, ([](F x) { return x * F(M_PI / 180); })>;
    case GLSLstd450Degrees:
      return per_word<F, 1, ([](F x) { return x * F(180 / M_PI); })>;
    case GLSLstd450Sin:
      return per_word<F, 1, ([](F x) { return std::sin(x); })>;
    case GLSLstd450Cos:
      return per_word<F, 1, ([](F x) { return std::cos(x); })>;
    case GLSLstd450Tan:
      return per_word<F, 1, ([](F x) { return std::tan(x); })>;
    case GLSLstd450Asin:
      return per_word<F, 1, ([](F x) { return std::asin(x); })>;
    case GLSLstd450Acos:
      return per_word<F, 1, ([](F x) { return std::acos(x); })>;
    case GLSLstd450Atan:
      return per_word<F, 1, ([](F x) { return std::atan(x); })>;
    case GLSLstd450Sinh:
      return per_word<F, 1, ([](F x) { return std::sinh(x); })>;
    case GLSLstd450Cosh:
      return per_word<F, 1, ([](F x) { return std::cosh(x); })>;
    case GLSLstd450Tanh:
      return per_word<F, 1, ([](F x) { return std::tanh(x); })>;
    case GLSLstd450Asinh:
      return per_word<F, 1, ([](F x) { return std::asinh(x); })>;
    case GLSLstd450Acosh:
      return per_word<F, 1, ([](F x) { return std::acosh(x); })>;
    case GLSLstd450Atanh:
      return per_word<F, 1, ([](F x) { return std::atanh(x); })>;
    case GLSLstd450Atan2:
      return per_word<F, 2, ([](F y, F x) { return std::atan2(y, x); })>;
    case GLSLstd450Pow:
      return per_word<F, 2, ([](F x, F y) { return std::pow(x, y); })>;
    case GLSLstd450Exp:
      return per_word<F, 1, ([](F x) { return std::exp(x); })>;
    case GLSLstd450Log:
      return per_word<F, 1, ([](F x) { return std::log(x); })>;
    case GLSLstd450Exp2:
      return per_word<F, 1, ([](F x) { return std::exp2(x); })>;
    case GLSLstd450Log2:
      return per_word<F, 1, ([](F x) { return std::log2(x); })>;
    case GLSLstd450Sqrt:
      return per_word<F, 1, ([](F x) { return std::sqrt(x); })>;
    case GLSLstd450InverseSqrt:
      return per_word<F, 1, ([](F x) { return 1 / std::sqrt(x); })>;
    default:
      return nullptr;
  }
}

Execute geometric_function(uint32_t function) {
  switch (function) {
    case GLSLstd450Length:
      return of_vectors<(
          [](Vectors v, uint32_t size, F* to) { to[0] = std::sqrt(dot_product(v[0], v[0], size)); })>;
    case GLSLstd450Distance:
      return of_vectors<([](Vectors v, uint32_t size, F* to) {
        for (uint32_t n = 0; n < size; ++n) v[0][n] -= v[1][n];
        to[0] = std::sqrt(dot_product(v[0], v[0], size));
      })>;
    case GLSLstd450Cross:
      return of_vectors<([](Vectors v, uint32_t, F* to) {
        for (uint32_t n = 0; n < 3; ++n)
          to[n] = v[0][(n + 1) % 3] * v[1][(n + 2) % 3] - v[0][(n + 2) % 3] * v[1][(n + 1) % 3];
      })>;
    case GLSLstd450Normalize:
      return of_vectors<([](Vectors v, uint32_t size, F* to) {
        const F length = std::sqrt(dot_product(v[0], v[0], size));
        for (uint32_t n = 0; n < size; ++n) to[n] = v[0][n] / length;
      })>;
    case GLSLstd450FaceForward:
      return of_vectors<([](Vectors v, uint32_t size, F* to) {
        const bool faces = dot_product(v[2], v[1], size) < 0;
        for (uint32_t n = 0; n < size; ++n) to[n] = faces ? v[0][n] : -v[0][n];
      })>;
    case GLSLstd450Reflect:
      return of_vectors<([](Vectors v, uint32_t size, F* to) {
        const F along = 2 * dot_product(v[1], v[0], size);
        for (uint32_t n = 0; n < size; ++n) to[n] = v[0][n] - along * v[1][n];
      })>;
    case GLSLstd450Refract:
      return of_vectors<([](Vectors v, uint32_t size, F* to) {
        const F eta = v[2][0], cosine = dot_product(v[1], v[0], size);
        const F k = 1 - eta * eta * (1 - cosine * cosine);
        for (uint32_t n = 0; n < size; ++n)
          to[n] = k < 0 ? 0.0f : eta * v[0][n] - (eta * cosine + std::sqrt(k)) * v[1][n];
      })>;
    case GLSLstd450Determinant:
      return of_vectors<([](Vectors v, uint32_t words, F* to) {
        to[0] = determinant(v[0], words == 4 ? 2 : words == 9 ? 3 : 4);
      })>;
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
    default:
      return nullptr;
  }
}

}  // namespace

Execute glsl_function(uint32_t function) {
  if (const Execute found = common_function(function)) return found;
  if (const Execute found = exponential_function(function)) return found;
  return geometric_function(function);
}

}  // namespace eyeray::engine::emulator
