#include <cmath>

#include <spirv/unified1/GLSL.std.450.h>

#include "host/emulator/columns.hpp"
#include "host/emulator/executes.hpp"

namespace eyeray::engine::emulator {
namespace {

constexpr auto least = [](auto x, auto y) { return y < x ? y : x; };
constexpr auto greatest = [](auto x, auto y) { return x < y ? y : x; };

constexpr auto lowest_bit = [](uint32_t x) { return x ? int32_t(std::countr_zero(x)) : -1; };
constexpr auto highest_bit = [](uint32_t x) { return 31 - int32_t(std::countl_zero(x)); };
constexpr auto highest_bit_of_signed = [](int32_t x) { return highest_bit(uint32_t(x < 0 ? ~x : x)); };

Execute common_function(uint32_t function, uint32_t bits) {
  switch (function) {
    case GLSLstd450Round:
    case GLSLstd450RoundEven:
      return reals<1, ([](auto x) { return std::nearbyint(x); })>(bits);
    case GLSLstd450Trunc:
      return reals<1, ([](auto x) { return std::trunc(x); })>(bits);
    case GLSLstd450FAbs:
      return reals<1, ([](auto x) { return std::fabs(x); })>(bits);
    case GLSLstd450SAbs:
      return integers<1, ([](auto x) {
                        return x < 0 ? decltype(x)(0u - std::make_unsigned_t<decltype(x)>(x)) : x;
                      })>(bits);
    case GLSLstd450FSign:
      return reals<1, ([](auto x) { return x > 0 ? decltype(x)(1) : x < 0 ? decltype(x)(-1) : x; })>(bits);
    case GLSLstd450SSign:
      return integers<1, ([](auto x) { return int(x > 0) - int(x < 0); })>(bits);
    case GLSLstd450Floor:
      return reals<1, ([](auto x) { return std::floor(x); })>(bits);
    case GLSLstd450Ceil:
      return reals<1, ([](auto x) { return std::ceil(x); })>(bits);
    case GLSLstd450Fract:
      return reals<1, ([](auto x) { return x - std::floor(x); })>(bits);
    case GLSLstd450FMin:
    case GLSLstd450NMin:
      return reals<2, ([](auto x, auto y) { return std::isnan(x)   ? y
                                                   : std::isnan(y) ? x
                                                                   : least(x, y); })>(
          bits);
    case GLSLstd450FMax:
    case GLSLstd450NMax:
      return reals<2, ([](auto x, auto y) {
                     return std::isnan(x) ? y : std::isnan(y) ? x : greatest(x, y);
                   })>(bits);
    case GLSLstd450UMin:
      return naturals<2, ([](auto x, auto y) { return x < y ? x : y; })>(bits);
    case GLSLstd450UMax:
      return naturals<2, ([](auto x, auto y) { return x < y ? y : x; })>(bits);
    case GLSLstd450SMin:
      return integers<2, ([](auto x, auto y) { return x < y ? x : y; })>(bits);
    case GLSLstd450SMax:
      return integers<2, ([](auto x, auto y) { return x < y ? y : x; })>(bits);
    case GLSLstd450FClamp:
    case GLSLstd450NClamp:
      return reals<3, ([](auto x, auto low, auto high) {
                     return least(std::isnan(x) ? low : greatest(x, low), high);
                   })>(bits);
    case GLSLstd450UClamp:
      return naturals<3, ([](auto x, auto low, auto high) { return x < low    ? low
                                                                   : x > high ? high
                                                                              : x; })>(
          bits);
    case GLSLstd450SClamp:
      return integers<3, ([](auto x, auto low, auto high) { return x < low    ? low
                                                                   : x > high ? high
                                                                              : x; })>(
          bits);
    case GLSLstd450FMix:
      return reals<3, ([](auto x, auto y, auto a) { return x * (1 - a) + y * a; })>(bits);
    case GLSLstd450Step:
      return reals<2, ([](auto edge, auto x) { return decltype(x)(x < edge ? 0 : 1); })>(bits);
    case GLSLstd450SmoothStep:
      return reals<3, ([](auto low, auto high, auto x) {
                     using T = decltype(x);
                     const T t = least(greatest((x - low) / (high - low), T(0)), T(1));
                     return t * t * (3 - 2 * t);
                   })>(bits);
    case GLSLstd450Fma:
      return reals<3, ([](auto x, auto y, auto z) { return x * y + z; })>(bits);
    case GLSLstd450FindILsb:
      return bits == 32 ? map<int32_t, uint32_t, 1, lowest_bit> : nullptr;
    case GLSLstd450FindUMsb:
      return bits == 32 ? map<int32_t, uint32_t, 1, highest_bit> : nullptr;
    case GLSLstd450FindSMsb:
      return bits == 32 ? map<int32_t, int32_t, 1, highest_bit_of_signed> : nullptr;
    default:
      return nullptr;
  }
}

Execute exponential_function(uint32_t function, uint32_t bits) {
  switch (function) {
    case GLSLstd450Radians:
      return reals<1, ([](auto x) { return x * decltype(x)(M_PI / 180); })>(bits);
    case GLSLstd450Degrees:
      return reals<1, ([](auto x) { return x * decltype(x)(180 / M_PI); })>(bits);
    case GLSLstd450Sin:
      return reals<1, ([](auto x) { return std::sin(x); })>(bits);
    case GLSLstd450Cos:
      return reals<1, ([](auto x) { return std::cos(x); })>(bits);
    case GLSLstd450Tan:
      return reals<1, ([](auto x) { return std::tan(x); })>(bits);
    case GLSLstd450Asin:
      return reals<1, ([](auto x) { return std::asin(x); })>(bits);
    case GLSLstd450Acos:
      return reals<1, ([](auto x) { return std::acos(x); })>(bits);
    case GLSLstd450Atan:
      return reals<1, ([](auto x) { return std::atan(x); })>(bits);
    case GLSLstd450Sinh:
      return reals<1, ([](auto x) { return std::sinh(x); })>(bits);
    case GLSLstd450Cosh:
      return reals<1, ([](auto x) { return std::cosh(x); })>(bits);
    case GLSLstd450Tanh:
      return reals<1, ([](auto x) { return std::tanh(x); })>(bits);
    case GLSLstd450Asinh:
      return reals<1, ([](auto x) { return std::asinh(x); })>(bits);
    case GLSLstd450Acosh:
      return reals<1, ([](auto x) { return std::acosh(x); })>(bits);
    case GLSLstd450Atanh:
      return reals<1, ([](auto x) { return std::atanh(x); })>(bits);
    case GLSLstd450Atan2:
      return reals<2, ([](auto y, auto x) { return std::atan2(y, x); })>(bits);
    case GLSLstd450Pow:
      return reals<2, ([](auto x, auto y) { return std::pow(x, y); })>(bits);
    case GLSLstd450Exp:
      return reals<1, ([](auto x) { return std::exp(x); })>(bits);
    case GLSLstd450Log:
      return reals<1, ([](auto x) { return std::log(x); })>(bits);
    case GLSLstd450Exp2:
      return reals<1, ([](auto x) { return std::exp2(x); })>(bits);
    case GLSLstd450Log2:
      return reals<1, ([](auto x) { return std::log2(x); })>(bits);
    case GLSLstd450Sqrt:
      return reals<1, ([](auto x) { return std::sqrt(x); })>(bits);
    case GLSLstd450InverseSqrt:
      return reals<1, ([](auto x) { return 1 / std::sqrt(x); })>(bits);
    default:
      return nullptr;
  }
}

}  // namespace

Execute glsl_function(uint32_t function, uint32_t bits) {
  if (const Execute found = common_function(function, bits)) return found;
  if (const Execute found = exponential_function(function, bits)) return found;
  if (const Execute found = geometric_function(function, bits)) return found;
  return packing_function(function);
}

}  // namespace eyeray::engine::emulator
