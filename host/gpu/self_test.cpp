#include "host/gpu/self_test.hpp"

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
constexpr uint32_t invocations = 1 << 16;
constexpr uint32_t words_an_invocation = 8;
constexpr uint32_t loop_iterations = 100000;
constexpr uint32_t denormal = 0x00000100u;

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

  Inputs() : words(3 * invocations + 2) {
    for (uint32_t i = 0; i < invocations; ++i) {
      const auto [a, b, c] = operands(i);
      words[i] = std::bit_cast<uint32_t>(a);
      words[invocations + i] = std::bit_cast<uint32_t>(b);
      words[2 * invocations + i] = std::bit_cast<uint32_t>(c);
    }
    words[3 * invocations] = denormal;
    words[3 * invocations + 1] = std::bit_cast<uint32_t>(0.0f);
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

// Adds the results of one invocation to the facts.
void judge_arithmetic(const Inputs& inputs, uint32_t i, const uint32_t* found, DeviceFacts& facts) {
  const float a = inputs.a(i), b = inputs.b(i);
  const float product = a * b;
  const float expected[] = {a + b, a - b, product, a / b, std::sqrt(std::fabs(a)), product + inputs.c(i)};
  for (size_t k = 0; k < std::size(expected); ++k) {
    const bool exact = std::bit_cast<uint32_t>(expected[k]) == found[2 + k];
    facts.exact_arithmetic = facts.exact_arithmetic && exact;
    if (k == 3 || k == 4) facts.exact_division = facts.exact_division && exact;
  }
}

DeviceFacts judge(const Device& device, const Inputs& inputs, std::span<const uint32_t> outputs) {
  DeviceFacts facts;
  facts.exact_arithmetic = facts.exact_division = true;
  for (uint32_t i = 0; i < invocations; ++i) {
    const uint32_t* found = &outputs[words_an_invocation * i];
    expect(device, "an integer hash", i, hash(i ^ inputs.words[i]), found[0]);
    expect(device, "an indexed load", i, inputs.words[invocations - 1 - i], found[1]);
    judge_arithmetic(inputs, i, found, facts);
  }
  const uint32_t* special = &outputs[words_an_invocation * invocations];
  facts.denormals_kept = special[0] == denormal / 2;
  facts.infinities_kept = special[1] == 0x7f800000u;
  facts.loop_iterations = special[2];
  facts.loop_cap = facts.loop_iterations != loop_iterations;

  // However many iterations ran, each must have done its work.
  uint32_t state = 0;
  for (uint32_t i = 0; i < facts.loop_iterations && i < loop_iterations; ++i)
    state = state * 1664525u + 1013904223u;
  expect(device, "a loop's result", 0, state, special[3]);
  return facts;
}

DeviceFacts run(Device& device, const ShaderSource& source, const KernelOptions& options,
                const DiskCache& cache) {
  const std::vector<uint32_t> spirv =
      of_own_input([&] { return compile_kernel(source, "", options, cache).spirv; });
  Kernel kernel(device, spirv, "selftest", cache);

  const Inputs inputs;
  Buffer input(device, inputs.words.size() * sizeof(uint32_t), "self-test inputs");
  Buffer output(device, (words_an_invocation * invocations + 4) * sizeof(uint32_t), "self-test outputs");
  input.upload_records(inputs.words);
  kernel.set_buffer(0, input);
  kernel.set_buffer(1, output);
  const uint32_t push_constants[] = {invocations, loop_iterations};
  dispatch(device, kernel, std::as_bytes(std::span(push_constants)),
           {invocations / kernel.reflection().local_size[0]});
  return judge(device, inputs, output.read_records<uint32_t>(output.size() / sizeof(uint32_t)));
}

}  // namespace

DeviceFacts self_test(Device& device, const SourceProvider& shaders, const DiskCache& cache, bool worst) {
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
