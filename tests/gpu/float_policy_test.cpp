#include <bit>
#include <cmath>
#include <map>
#include <set>
#include <spirv-tools/libspirv.hpp>
#include <spirv/unified1/spirv.hpp>

#include "host/spirv/words.hpp"
#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

const std::string arithmetic = R"(#version 450
layout(local_size_x = 64) in;
layout(std430, binding = 0) buffer Data { vec4 data[]; };
float helper(vec4 a, vec4 b) { return dot(a, b) - a.x / b.x + mod(a.y, b.y); }
void main() {
  vec4 a = data[0];
  precise vec4 b = a * a + a;
  mat4 m = mat4(a, b, a, b);
  uint integers = uint(a.x) * 3u + 1u;
  data[1] = m * a + a * 2.0 - (b * m) * float(integers) + helper(a, -b) * outerProduct(a, b)[0] * (m * m)[1] + (m * 2.0)[0];
}
)";

size_t count(const std::vector<uint32_t>& spirv, spv::Op wanted, uint32_t third = 0) {
  size_t found = 0;
  spirv::for_each_instruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> instruction) {
    found += opcode == uint32_t(wanted) && (third == 0 || instruction[2] == third);
  });
  return found;
}

// The number of NoContraction decorations of each float arithmetic result.
std::map<uint32_t, int> decorations(const std::vector<uint32_t>& spirv) {
  const std::set<uint32_t> arithmetic_opcodes = {spv::OpFNegate,
                                                 spv::OpFAdd,
                                                 spv::OpFSub,
                                                 spv::OpFMul,
                                                 spv::OpFDiv,
                                                 spv::OpFRem,
                                                 spv::OpFMod,
                                                 spv::OpVectorTimesScalar,
                                                 spv::OpMatrixTimesScalar,
                                                 spv::OpVectorTimesMatrix,
                                                 spv::OpMatrixTimesVector,
                                                 spv::OpMatrixTimesMatrix,
                                                 spv::OpOuterProduct,
                                                 spv::OpDot};
  std::map<uint32_t, int> times, decorated;
  spirv::for_each_instruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> instruction) {
    if (opcode == spv::OpDecorate && instruction[2] == spv::DecorationNoContraction)
      ++decorated[instruction[1]];
    if (arithmetic_opcodes.contains(opcode)) times[instruction[2]] = decorated[instruction[2]];
  });
  return times;
}

std::string validate(const std::vector<uint32_t>& spirv) {
  std::string messages;
  spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
  tools.SetMessageConsumer(
      [&](spv_message_level_t, const char*, const spv_position_t&, const char* text) { messages += text; });
  if (!tools.Validate(spirv)) messages += " invalid";
  return messages;
}

}  // namespace

TEST_CASE("NoContraction is on every float arithmetic result, once, and the module stays valid") {
  const std::vector<uint32_t> plain = compile(arithmetic);
  const std::vector<uint32_t> strict = gpu::decorate_no_contraction(plain);
  std::map<int, size_t> before, after;
  for (const auto& [id, times] : decorations(plain)) ++before[times];
  for (const auto& [id, times] : decorations(strict)) ++after[times];
  CHECK(before[0] > 5);
  CHECK(before[1] > 0);  // `precise`
  CHECK(after == std::map<int, size_t>{{1, before[0] + before[1]}});
  CHECK(count(plain, spv::OpDot) == 1);
  CHECK(validate(plain) == "");
  CHECK(validate(strict) == "");
  CHECK(gpu::decorate_no_contraction(strict) == strict);
}

TEST_CASE("float modes are declared on the entry point, and the module stays valid") {
  const std::vector<uint32_t> plain = compile(arithmetic);
  CHECK(gpu::set_float_modes(plain, {}) == plain);
  const std::vector<uint32_t> strict = gpu::set_float_modes(plain, {true, true, true});
  CHECK(validate(strict) == "");
  for (const spv::ExecutionMode mode : {spv::ExecutionModeDenormPreserve, spv::ExecutionModeRoundingModeRTE,
                                        spv::ExecutionModeSignedZeroInfNanPreserve})
    CHECK(count(strict, spv::OpExecutionMode, mode) == 1);
  CHECK(count(gpu::set_float_modes(plain, {false, true, false}), spv::OpExecutionMode) ==
        count(plain, spv::OpExecutionMode) + 1);
}

TEST_CASE("words that are not SPIR-V are refused") {
  std::vector<uint32_t> words = compile(arithmetic);
  CHECK(error_of([] { gpu::decorate_no_contraction(std::vector<uint32_t>{1, 2, 3}); }).second ==
        ExitCode::bad_input);
  words.back() = 0x00090001u;  // an instruction that reaches past the end
  CHECK(contains(error_of([&] { gpu::reflect(words); }).first, "breaks off"));
  words.back() = 0;
  CHECK(contains(error_of([&] { gpu::reflect(words); }).first, "breaks off"));
}

TEST_CASE("a·b + c rounds twice") {
  const std::vector<uint32_t> plain = word_kernel(
      "float a = uintBitsToFloat(data[3u * i]);\nfloat b = uintBitsToFloat(data[3u * i + 1u]);\n"
      "data[3u * i + 2u] = floatBitsToUint(a * b + uintBitsToFloat(data[3u * i + 2u]));");
  const std::vector<uint32_t> spirv =
      gpu::set_float_modes(gpu::decorate_no_contraction(plain), device().info().float_modes);
  gpu::Kernel kernel(device(), spirv, "multiply and add", no_cache);
  constexpr uint32_t triples = 1024;
  std::vector<uint32_t> words(3 * triples), expected(triples);
  uint32_t fused_differs = 0;
  for (uint32_t i = 0; i < triples; ++i) {
    const float a = 1.0f + float(i * 7919 % 8191) / 8192.0f, b = 1.0f + float(i * 104729 % 65521) / 65536.0f;
    const float product = a * b, c = -product;
    words[3 * i] = std::bit_cast<uint32_t>(a);
    words[3 * i + 1] = std::bit_cast<uint32_t>(b);
    words[3 * i + 2] = std::bit_cast<uint32_t>(c);
    expected[i] = std::bit_cast<uint32_t>(product + c);
    fused_differs += std::bit_cast<uint32_t>(std::fma(a, b, c)) != expected[i];
  }
  CHECK(fused_differs > triples / 4);  // the test can detect fusing
  gpu::Buffer data(device(), words.size() * 4, "data");
  data.upload_records(words);
  kernel.set_buffer(0, data);
  gpu::dispatch(device(), kernel, {}, {triples / 64});
  const std::vector<uint32_t> results = data.read_records<uint32_t>(words.size());
  for (uint32_t i = 0; i < triples; ++i) CHECK(results[3 * i + 2] == expected[i]);
}
