#include "host/gpu/spirv_optimiser.hpp"

#include <spirv-tools/libspirv.hpp>
#include <spirv/unified1/spirv.hpp>

#include "host/spirv/words.hpp"
#include "support.hpp"
#include "tests/support/process.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

size_t count(const std::vector<uint32_t>& spirv, std::initializer_list<spv::Op> wanted) {
  size_t found = 0;
  spirv::for_each_instruction(spirv, [&](uint32_t opcode, std::span<const uint32_t>) {
    found += std::find(wanted.begin(), wanted.end(), spv::Op(opcode)) != wanted.end();
  });
  return found;
}

size_t arithmetic_in(const std::vector<uint32_t>& spirv) {
  return count(spirv, {spv::OpFAdd, spv::OpFSub, spv::OpFMul, spv::OpFDiv, spv::OpFNegate, spv::OpDot,
                       spv::OpVectorTimesScalar});
}

// Expressions that algebra of real numbers would shorten, but that floats must compute as they stand.
const std::string shortenable =
    "float x = uintBitsToFloat(data[i]);\n"
    "float third = 1.0 / 3.0 * 0.1 + 0.7;\n"
    "float sum = (x + 1.0) - 1.0 + (x + 0.0) + (x * 3.0) * 5.0 + x * 0.0 + (x / 3.0) * 3.0 - (-(-x)) + (x - "
    "x) * third;\n"
    "vec3 v = vec3(x, 2.0 * x, 3.0) * 4.0 * 0.25;\n"
    "data[i] = floatBitsToUint(sum + dot(v, vec3(0.0, 1.0, 0.0)) + x / 7.0 / 9.0);";

}  // namespace

TEST_CASE("decorated arithmetic is not folded") {
  const std::vector<uint32_t> plain = word_kernel(shortenable);
  const std::vector<uint32_t> strict = gpu::decorate_no_contraction(plain);
  CHECK(arithmetic_in(gpu::optimise(strict)) == arithmetic_in(plain));
  CHECK(arithmetic_in(gpu::optimise(plain)) + 5 < arithmetic_in(plain));  // the test can detect folding
}

TEST_CASE("an optimised kernel has the same bits") {
  const std::vector<uint32_t> strict = gpu::decorate_no_contraction(word_kernel(shortenable));
  constexpr uint32_t numbers = 4096;
  std::vector<uint32_t> words(numbers), results[2];
  for (uint32_t i = 0; i < numbers; ++i)
    words[i] = i < 64 ? i << 26 : i * 2654435761u;  // zeros, infinities and NaN too
  for (const bool optimised : {false, true}) {
    const std::vector<uint32_t> spirv =
        gpu::set_float_modes(optimised ? gpu::optimise(strict) : strict, device().info().float_modes);
    gpu::Kernel kernel(device(), spirv, "bits", no_cache);
    gpu::Buffer data(device(), words.size() * 4, "data");
    data.upload_records(words);
    kernel.set_buffer(0, data);
    gpu::dispatch(device(), kernel, {}, {numbers / 64});
    results[optimised] = data.read_records<uint32_t>(words.size());
  }
  CHECK(results[0] != words);
  CHECK(results[0] == results[1]);
}

TEST_CASE("functions are inlined, unused code is removed, and the module stays valid") {
  const std::vector<uint32_t> plain = compile(R"(#version 450
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Data { float data[]; };
layout(std430, binding = 1) buffer More { float more[]; };
float early(float x) {
  for (int i = 0; i < 9; ++i) if (data[i] > x) return data[i];
  return x;
}
void main() {
  float wasted = early(data[1]) * 2.0;
  data[2] = early(data[3]);
  if (false) data[4] = more[0];
}
)");
  const std::vector<uint32_t> optimised = gpu::optimise(plain);
  CHECK(count(plain, {spv::OpFunction}) == 2);
  CHECK(count(optimised, {spv::OpFunction}) == 1);
  CHECK(count(plain, {spv::OpFMul}) == 1);
  CHECK(count(optimised, {spv::OpFMul}) == 0);
  CHECK(gpu::reflect(plain).bindings.size() == 2);
  CHECK(gpu::reflect(optimised).bindings.size() == 1);
  CHECK(spvtools::SpirvTools(SPV_ENV_VULKAN_1_1).Validate(optimised));
}

TEST_CASE("a module that inlining would make too large is returned unchanged, at once") {
  const auto doubling = [](int functions) {
    std::string text =
        "#version 450\nlayout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer Data { float data[]; "
        "};\n"
        "float f0(float x) { return x * data[1] + 1.0; }\n";
    for (int i = 1; i <= functions; ++i)
      text += fmt::format("float f{0}(float x) {{ return f{1}(x + {0}.5) * f{1}(x - {0}.25); }}\n", i, i - 1);
    return compile(text + fmt::format("void main() {{ data[0] = f{}(data[2]); }}\n", functions));
  };
  const std::vector<uint32_t> few = doubling(4), many = doubling(40);
  CHECK(gpu::optimise(few) != few);
  CHECK(gpu::optimise(many) == many);
}

TEST_CASE("words that are not SPIR-V are not optimised") {
  CHECK(error_of([] { gpu::optimise(std::vector<uint32_t>{1, 2, 3}); }).second == ExitCode::bad_input);
}

TEST_CASE("a kernel has the float policy before it is optimised, whether cached or not") {
  const TemporaryFolder folder;
  const DiskCache cache(folder.path());
  const auto read = [](std::string_view) -> std::optional<std::string> {
    return R"(#version 450
layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Data { float data[]; };
void main() { data[0] = (data[1] + 2.0) + 3.0; }
)";
  };
  const gpu::ShaderSource source = gpu::read_shader(read, "m");
  const auto words = [&](const gpu::KernelOptions& options) {
    return gpu::compile_kernel(source, "", options, cache).spirv;
  };
  const gpu::KernelOptions strict{gpu::FloatModes{true, true, true}}, fast,
      fast_as_written{.optimise = false};
  for (int time = 0; time < 2; ++time) {
    CHECK(count(words(strict), {spv::OpFAdd}) == 2);
    CHECK(count(words(strict), {spv::OpExecutionMode}) == 4);
    CHECK(gpu::decorate_no_contraction(words(strict)) == words(strict));
    CHECK(count(words(fast), {spv::OpFAdd}) == 1);  // the addition of x + 5
    CHECK(count(words(fast), {spv::OpExecutionMode}) == 1);
    CHECK(count(words(fast_as_written), {spv::OpFAdd}) == 2);
  }
}
