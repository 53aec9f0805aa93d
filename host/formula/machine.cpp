#include "host/formula/machine.hpp"

#include <algorithm>
#include <cmath>

#include "host/core/error.hpp"
#include "shaders/language.h"
//
#include "host/core/local_shaders.hpp"

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include "shaders/math/formula.glsl"
#pragma GCC diagnostic pop

namespace eyeray::engine::formula {

namespace {

// Functions of floats: those of the shaders in float32, those of C's library in float64.
// clang-format off
template <typename T> struct Functions;
#define SHADER_ONE(name) static float name(float x) { return shader::fn_##name(x); }
#define SHADER_TWO(name) static float name(float x, float y) { return shader::fn_##name(x, y); }
#define SHADER_THREE(name) static float name(float x, float y, float z) { return shader::fn_##name(x, y, z); }
template <> struct Functions<float> {
  SHADER_ONE(abs) SHADER_ONE(sign) SHADER_ONE(floor) SHADER_ONE(ceil) SHADER_ONE(trunc) SHADER_ONE(round) SHADER_ONE(fract) SHADER_ONE(sqrt)
  SHADER_ONE(inversesqrt) SHADER_ONE(radians) SHADER_ONE(degrees) SHADER_ONE(sin) SHADER_ONE(cos) SHADER_ONE(tan) SHADER_ONE(asin)
  SHADER_ONE(acos) SHADER_ONE(atan) SHADER_ONE(exp) SHADER_ONE(log) SHADER_ONE(exp2) SHADER_ONE(log2) SHADER_ONE(sinh) SHADER_ONE(cosh)
  SHADER_ONE(tanh) SHADER_TWO(atan) SHADER_TWO(pow) SHADER_TWO(min) SHADER_TWO(max) SHADER_TWO(mod) SHADER_TWO(step)
  SHADER_THREE(clamp) SHADER_THREE(mix) SHADER_THREE(smoothstep)
};
#undef SHADER_ONE
#undef SHADER_TWO
#undef SHADER_THREE

#define C_ONE(name) static double name(double x) { return std::name(x); }
template <> struct Functions<double> {
  C_ONE(floor) C_ONE(ceil) C_ONE(trunc) C_ONE(sqrt) C_ONE(sin) C_ONE(cos) C_ONE(tan) C_ONE(asin) C_ONE(acos) C_ONE(atan) C_ONE(exp) C_ONE(log)
  C_ONE(exp2) C_ONE(log2) C_ONE(sinh) C_ONE(cosh) C_ONE(tanh)
  static double abs(double x) { return std::fabs(x); }
  static double sign(double x) { return double(x > 0) - double(x < 0); }
  static double round(double x) { return std::floor(x + 0.5); }
  static double fract(double x) { return x - std::floor(x); }
  static double inversesqrt(double x) { return 1 / std::sqrt(x); }
  static double radians(double x) { return x * 0.017453292519943295; }
  static double degrees(double x) { return x * 57.29577951308232; }
  static double atan(double y, double x) { return std::atan2(y, x); }
  static double pow(double x, double y) { return std::pow(x, y); }
  static double min(double x, double y) { return y < x ? y : x; }
  static double max(double x, double y) { return x < y ? y : x; }
  static double mod(double x, double y) { return x - y * std::floor(x / y); }
  static double step(double edge, double x) { return x < edge ? 0 : 1; }
  static double clamp(double x, double low, double high) { return min(max(x, low), high); }
  static double mix(double x, double y, double share) { return x + (y - x) * share; }
  static double smoothstep(double low, double high, double x) {
    const double t = clamp((x - low) / (high - low), 0, 1);
    return t * t * (3 - 2 * t);
  }
};
#undef C_ONE
// clang-format on

int32_t as_signed(uint32_t x) {
  return int32_t(x);
}
// The quotient, rounded towards zero; x / 0 is 0, and −2³¹ / −1 wraps around.
uint32_t signed_divide(uint32_t x, uint32_t y) {
  return y == 0 ? 0 : y == ~0u ? 0u - x : uint32_t(as_signed(x) / as_signed(y));
}
uint32_t signed_remainder(uint32_t x, uint32_t y) {
  return y == 0 || y == ~0u ? 0 : uint32_t(as_signed(x) % as_signed(y));
}
// The remainder with the sign of y.
uint32_t signed_modulo(uint32_t x, uint32_t y) {
  const uint32_t rest = signed_remainder(x, y);
  return rest != 0 && as_signed(rest ^ y) < 0 ? rest + y : rest;
}
template <typename T>
uint32_t to_signed(T x) {
  return x >= T(-2147483648.0) && x < T(2147483648.0) ? uint32_t(int32_t(x)) : 0x80000000u;
}
template <typename T>
uint32_t to_unsigned(T x) {
  return x >= 0 && x < T(4294967296.0) ? uint32_t(x) : 0u;
}
uint32_t clamp_index(uint32_t i, uint32_t length) {
  return as_signed(i) < 0 ? 0 : std::min(i, length - 1);
}

}  // namespace

// A thread's files of numbers for one machine. They already contain the constants.
template <typename T>
struct Machine::Files {
  uint64_t machine = 0;
  std::vector<T> reals{};
  std::vector<uint32_t> wholes{};

  static Files& of(const Machine& machine) {
    thread_local std::array<Files, 4> all;
    thread_local size_t next = 0;
    for (Files& files : all)
      if (files.machine == machine.id_) return files;
    Files& files = all[next++ % all.size()];
    files.machine = machine.id_;
    files.reals.assign(machine.real_count_, T(0));
    files.wholes.assign(machine.whole_count_, 0u);
    std::ranges::copy(machine.reals_, files.reals.begin());
    std::ranges::copy(machine.wholes_, files.wholes.begin());
    return files;
  }
};

template <typename T>
bool Machine::run_as(std::span<const T> input, T* result, uint64_t* iterations) const {
  using F = Functions<T>;
  using ir::Op;
  Files<T>& files = Files<T>::of(*this);
  T* const r = files.reals.data();
  uint32_t* const w = files.wholes.data();
  CHECK(input.size() == input_count_);
  std::ranges::copy(input, r + input_);
  uint64_t made = 0;
  const Code* at = code_.data();

  // The position of an array's element. The index is limited to the array's last element.
  const auto element = [](const Code& code, uint32_t index) {
    return code.array + std::min(index, code.length - 1);
  };
  for (;;) {
    const Code& c = *at++;
    const auto& [x, y, z] = c.from;
    // clang-format off
    switch (c.op) {
#define REAL(op, value) case uint16_t(Op::op): r[c.to] = value; break;
#define WHOLE(op, value) case uint16_t(Op::op): w[c.to] = value; break;
      REAL(negate, -r[x])
      REAL(add, r[x] + r[y])
      REAL(subtract, r[x] - r[y])
      REAL(multiply, r[x] * r[y])
      REAL(divide, r[x] / r[y])
      REAL(absolute, F::abs(r[x]))
      REAL(sign, F::sign(r[x]))
      REAL(floor, F::floor(r[x]))
      REAL(ceil, F::ceil(r[x]))
      REAL(trunc, F::trunc(r[x]))
      REAL(round, F::round(r[x]))
      REAL(fract, F::fract(r[x]))
      REAL(sqrt, F::sqrt(r[x]))
      REAL(inversesqrt, F::inversesqrt(r[x]))
      REAL(radians, F::radians(r[x]))
      REAL(degrees, F::degrees(r[x]))
      REAL(sin, F::sin(r[x]))
      REAL(cos, F::cos(r[x]))
      REAL(tan, F::tan(r[x]))
      REAL(asin, F::asin(r[x]))
      REAL(acos, F::acos(r[x]))
      REAL(atan, F::atan(r[x]))
      REAL(exp, F::exp(r[x]))
      REAL(log, F::log(r[x]))
      REAL(exp2, F::exp2(r[x]))
      REAL(log2, F::log2(r[x]))
      REAL(sinh, F::sinh(r[x]))
      REAL(cosh, F::cosh(r[x]))
      REAL(tanh, F::tanh(r[x]))
      REAL(atan2, F::atan(r[x], r[y]))
      REAL(pow, F::pow(r[x], r[y]))
      REAL(min, F::min(r[x], r[y]))
      REAL(max, F::max(r[x], r[y]))
      REAL(mod, F::mod(r[x], r[y]))
      REAL(step, F::step(r[x], r[y]))
      REAL(clamp, F::clamp(r[x], r[y], r[z]))
      REAL(mix, F::mix(r[x], r[y], r[z]))
      REAL(smoothstep, F::smoothstep(r[x], r[y], r[z]))
      REAL(from_signed, T(as_signed(w[x])))
      REAL(from_unsigned, T(w[x]))
      WHOLE(less, r[x] < r[y])
      WHOLE(less_equal, r[x] <= r[y])
      WHOLE(equal, r[x] == r[y])
      WHOLE(to_signed, to_signed(r[x]))
      WHOLE(to_unsigned, to_unsigned(r[x]))
      WHOLE(move, w[x])
      WHOLE(whole_negate, 0u - w[x])
      WHOLE(whole_add, w[x] + w[y])
      WHOLE(whole_subtract, w[x] - w[y])
      WHOLE(whole_multiply, w[x] * w[y])
      WHOLE(signed_divide, signed_divide(w[x], w[y]))
      WHOLE(unsigned_divide, w[y] == 0 ? 0 : w[x] / w[y])
      WHOLE(signed_remainder, signed_remainder(w[x], w[y]))
      WHOLE(unsigned_remainder, w[y] == 0 ? 0 : w[x] % w[y])
      WHOLE(signed_modulo, signed_modulo(w[x], w[y]))
      WHOLE(bit_and, w[x] & w[y])
      WHOLE(bit_or, w[x] | w[y])
      WHOLE(bit_xor, w[x] ^ w[y])
      WHOLE(bit_not, ~w[x])
      WHOLE(shift_left, w[x] << (w[y] & 31u))
      WHOLE(shift_right, w[x] >> (w[y] & 31u))
      WHOLE(signed_shift_right, uint32_t(as_signed(w[x]) >> (w[y] & 31u)))
      WHOLE(whole_equal, w[x] == w[y])
      WHOLE(signed_less, as_signed(w[x]) < as_signed(w[y]))
      WHOLE(unsigned_less, w[x] < w[y])
      WHOLE(clamp_index, clamp_index(w[x], c.length))
      WHOLE(both, w[x] & w[y])
      WHOLE(either, w[x] | w[y])
      WHOLE(opposite, w[x] ^ 1u)
      WHOLE(same, w[x] == w[y])
      WHOLE(select, w[x] ? w[y] : w[z])
      WHOLE(load, w[element(c, w[x])])
      case uint16_t(Op::store): w[element(c, w[x])] = w[y]; break;
      case uint16_t(Op::clear): std::fill_n(w + c.array, c.length, 0u); break;
      case uint16_t(Op::copy): std::copy_n(w + x, c.length, w + c.array); break;
      case move_real: r[c.to] = r[x]; break;
      case select_real: r[c.to] = w[x] ? r[y] : r[z]; break;
      case load_real: r[c.to] = r[element(c, w[x])]; break;
      case store_real: r[element(c, w[x])] = r[y]; break;
      case clear_real: std::fill_n(r + c.array, c.length, T(0)); break;
      case copy_real: std::copy_n(r + x, c.length, r + c.array); break;
      case jump: at = code_.data() + c.to; break;
      case jump_if: if (w[x]) at = code_.data() + c.to; break;
      case jump_unless: if (!w[x]) at = code_.data() + c.to; break;
      case iterate:
        made += c.length;
        if (made <= FORMULA_ITERATIONS) break;
        if (iterations) *iterations += made;
        return false;
      case end:
        for (size_t i = 0; result && i < results_.size(); ++i) result[i] = r[results_[i]];
        if (iterations) *iterations += made;
        return true;
      default: CHECK(false);
    }
    // clang-format on
  }
}

bool Machine::run(std::span<const float> input, float* result, uint64_t* iterations) const {
  return run_as(input, result, iterations);
}
bool Machine::run(std::span<const double> input, double* result, uint64_t* iterations) const {
  return run_as(input, result, iterations);
}

std::vector<uint32_t> Machine::bits() const {
  CHECK(run_as<float>({}, nullptr, nullptr));
  const Files<float>& files = Files<float>::of(*this);
  std::vector<uint32_t> bits;
  for (const uint32_t at : results_)
    bits.push_back(gives_reals_ ? __builtin_bit_cast(uint32_t, files.reals[at]) : files.wholes[at]);
  return bits;
}

}  // namespace eyeray::engine::formula
