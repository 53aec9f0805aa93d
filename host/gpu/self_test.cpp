#include "host/gpu/self_test.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "host/core/error.hpp"
#include "host/core/option_text.hpp"
#include "host/core/stopwatch.hpp"
#include "host/gpu/command_list.hpp"
#include "host/gpu/kernel_compiler.hpp"

namespace eyeray::engine::gpu {
namespace {

// The same constants as in kernels/selftest.comp.glsl.
constexpr uint32_t ordinary = 1 << 16;  // invocations with operands far from the ends of the range
constexpr uint32_t words_an_invocation = 10;
constexpr uint32_t loop_iterations = 100000;

// Each pair of these numbers has one more invocation: zeros, denormals, the least normal numbers, infinities,
// NaN, and numbers whose products, quotients or differences are such.
constexpr uint32_t special[] = {0x00000000u, 0x80000000u, 0x00000001u, 0x00000100u, 0x807fffffu, 0x00800000u,
                                0x80800001u, 0x0d800000u, 0x1e3ce508u, 0xbfc00000u, 0x3f800000u, 0x3f000000u,
                                0x7f7fffffu, 0x7f800000u, 0xff800000u, 0x7fc00000u};
constexpr uint32_t specials = uint32_t(std::size(special));
constexpr uint32_t invocations = ordinary + specials * specials;

uint32_t hash(uint32_t x) {
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ x >> 16;
}

// A float of either sign with a random mantissa, 2^-8 ≤ |x| < 2^8: no operation here leaves the normal range.
float random_float(uint32_t seed) {
  const uint32_t bits = hash(seed);
  const uint32_t exponent = 127 - 8 + (bits >> 23 & 15u);
  return std::bit_cast<float>((bits & 0x807fffffu) | exponent << 23);
}

// a, b and c of an invocation. A quarter of the divisions and roots are close to the middle between two
// floats, where an approximate result is most easily rounded to the wrong one.
struct Operands {
  float a, b, c;
};
Operands operands(uint32_t i) {
  if (i >= ordinary) {
    const auto nth = [](uint32_t n) { return std::bit_cast<float>(special[n % specials]); };
    return {nth(i), nth((i - ordinary) / specials), nth(5 * i + 3)};
  }
  float a = random_float(3 * i), b = random_float(3 * i + 1);
  const double middle =
      double((hash(3 * i) & 0x00ffffffu) | 0x01000001u);  // odd, of 25 bits: between two floats
  if (i % 4 == 2) {
    b = float((hash(3 * i + 1) & 0x007fffffu) | 0x00800000u);
    a = float(middle * double(b) * 0x1p-25);
  } else if (i % 4 == 3) {
    a = float(middle * middle * 0x1p-48);
  }
  // Half of the sums cancel, so that a fused operation leaves only the digits that the rounded product lost.
  return {a, b, i % 2 == 0 ? -(a * b) : random_float(3 * i + 2)};
}

struct Inputs {
  std::vector<uint32_t> words;

  Inputs() : words(3 * invocations) {
    for (uint32_t i = 0; i < invocations; ++i) {
      const auto [a, b, c] = operands(i);
      words[i] = std::bit_cast<uint32_t>(a);
      words[invocations + i] = std::bit_cast<uint32_t>(b);
      words[2 * invocations + i] = std::bit_cast<uint32_t>(c);
    }
  }
  float a(uint32_t i) const { return std::bit_cast<float>(words[i]); }
  float b(uint32_t i) const { return std::bit_cast<float>(words[invocations + i]); }
  float c(uint32_t i) const { return std::bit_cast<float>(words[2 * invocations + i]); }
};

void expect(const Device& device, const char* what, uint32_t index, uint32_t expected, uint32_t found) {
  if (found == expected) return;
  throw Error(ExitCode::no_device,
              "{} (driver {} {}) computes wrong results: {} of invocation {} should be {:#010x}, but is "
              "{:#010x}; choose another device with {}, or update the driver",
              device.info().name, device.info().driver, device.info().driver_version, what, index, expected,
              found, option_text("device"));
}

// True if `bits` are those of x. Every NaN is the same.
bool has_bits(float x, uint32_t bits) {
  return std::isnan(x) ? std::isnan(std::bit_cast<float>(bits)) : std::bit_cast<uint32_t>(x) == bits;
}

// Adds the results of one invocation to the facts. Returns false if a division or a root of denormals is
// wrong.
bool judge_arithmetic(const Inputs& inputs, uint32_t i, const uint32_t* found, DeviceFacts& facts) {
  const float a = inputs.a(i), b = inputs.b(i);
  const float product = a * b;
  const float expected[] = {
      a + b, a - b, product, a / b, std::sqrt(std::fabs(a)), product + inputs.c(i), std::floor(a)};
  const uint32_t comparison =
      (a < b ? 1u : 0u) | (a <= b ? 2u : 0u) | (a == b ? 4u : 0u) | (a != b ? 8u : 0u);
  bool divides_denormals = true;
  for (size_t k = 0; k <= std::size(expected); ++k) {
    const bool compares = k == std::size(expected);
    if (compares ? comparison == found[2 + k] : has_bits(expected[k], found[2 + k])) continue;
    facts.exact_arithmetic = false;
    const bool divides = k == 3 || k == 4;
    // The reason, where there is only one.
    const float numbers[] = {a, b, compares ? a : expected[k]};
    const bool any_denormal =
        std::ranges::any_of(numbers, [](float x) { return std::fpclassify(x) == FP_SUBNORMAL; });
    const bool any_infinity = std::ranges::any_of(numbers, [](float x) { return std::isinf(x); });
    if (divides && !any_denormal) facts.exact_division = false;
    if (divides && any_denormal) divides_denormals = false;
    if (k == 5 || any_denormal == any_infinity) continue;
    if (any_infinity) facts.infinities_kept = false;
    if (any_denormal && !divides) facts.denormals_kept = false;
  }
  return divides_denormals;
}

DeviceFacts judge(const Device& device, const Inputs& inputs, std::span<const uint32_t> outputs) {
  DeviceFacts facts;
  facts.exact_arithmetic = facts.exact_division = facts.denormals_kept = facts.infinities_kept = true;
  bool divides_denormals = true;
  for (uint32_t i = 0; i < invocations; ++i) {
    const uint32_t* found = &outputs[words_an_invocation * i];
    expect(device, "an integer hash", i, hash(i ^ inputs.words[i]), found[0]);
    expect(device, "an indexed load", i, inputs.words[invocations - 1 - i], found[1]);
    divides_denormals = judge_arithmetic(inputs, i, found, facts) && divides_denormals;
  }
  // No correction helps a device that flushes denormals.
  if (facts.denormals_kept && !divides_denormals) facts.exact_division = false;
  const uint32_t* loop = &outputs[words_an_invocation * invocations];
  facts.loop_iterations = loop[0];
  facts.loop_cap = facts.loop_iterations != loop_iterations;

  // However many iterations ran, each must have done its work.
  uint32_t state = 0;
  for (uint32_t i = 0; i < facts.loop_iterations && i < loop_iterations; ++i)
    state = state * 1664525u + 1013904223u;
  expect(device, "a loop's result", 0, state, loop[1]);
  return facts;
}

DeviceFacts run(Device& device, const ShaderSource& source, const KernelOptions& options,
                const DiskCache& cache) {
  const std::vector<uint32_t> spirv =
      of_own_input([&] { return compile_kernel(source, "", options, cache).spirv; });
  Kernel kernel(device, spirv, "selftest", cache);

  const Inputs inputs;
  Buffer input(device, inputs.words.size() * sizeof(uint32_t), "self-test inputs");
  Buffer output(device, (words_an_invocation * invocations + 2) * sizeof(uint32_t), "self-test outputs");
  input.upload_records(inputs.words);
  kernel.set_buffer(0, input);
  kernel.set_buffer(1, output);
  const uint32_t push_constants[] = {invocations, loop_iterations};
  dispatch(device, kernel, std::as_bytes(std::span(push_constants)),
           {invocations / kernel.reflection().local_size[0]});
  return judge(device, inputs, output.read_records<uint32_t>(output.size() / sizeof(uint32_t)));
}

}  // namespace

DeviceFacts self_test(Device& device, const SourceProvider& shaders, const DiskCache& cache,
                      const WorstDevice& worst) {
  const Stopwatch watch;
  const ShaderSource source = read_shader(shaders, "kernels/selftest.comp.glsl");
  KernelOptions options{.strict = device.info().float_modes, .worst = worst};
  DeviceFacts facts = run(device, source, options, cache);
  options.exact = !facts.exact_division;
  if (options.exact) facts.exact_arithmetic = run(device, source, options, cache).exact_arithmetic;
  facts.seconds = watch.seconds();
  return facts;
}

DeviceFacts expected_of_gpus() {
  return {.loop_iterations = loop_iterations,
          .denormals_kept = true,
          .infinities_kept = true,
          .exact_arithmetic = true};
}

}  // namespace eyeray::engine::gpu
