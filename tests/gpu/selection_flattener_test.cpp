#include "host/gpu/selection_flattener.hpp"

#include <spirv/unified1/GLSL.std.450.h>

#include <spirv-tools/libspirv.hpp>
#include <spirv/unified1/spirv.hpp>

#include "host/gpu/spirv_optimiser.hpp"
#include "host/spirv/words.hpp"
#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

int count(const std::vector<uint32_t>& spirv, spv::Op wanted) {
  int found = 0;
  spirv::for_each_instruction(
      spirv, [&](uint32_t opcode, std::span<const uint32_t>) { found += spv::Op(opcode) == wanted; });
  return found;
}

bool writes_whole_part(const std::vector<uint32_t>& spirv) {
  bool found = false;
  spirv::for_each_instruction(spirv, [&](uint32_t opcode, std::span<const uint32_t> instruction) {
    found = found || (opcode == spv::OpExtInst && instruction[4] == GLSLstd450Modf);
  });
  return found;
}

// The number of selections that flattening leaves in a kernel with this body.
int left_of(const std::string& body) {
  const std::vector<uint32_t> flat = gpu::optimise(word_kernel(body), true);
  CHECK(spvtools::SpirvTools(SPV_ENV_VULKAN_1_1).Validate(flat));
  return count(flat, spv::OpSelectionMerge);
}

// Selections within selections, behind each other and around a loop; of scalars and vectors, of one arm and
// of two.
const std::string choosing = R"(
  uint x = data[i];
  vec3 v = vec3(float(x & 7u), 2.0, uintBitsToFloat(x));
  uint y = x > 100u ? x * 3u + 1u : (x & 1u) == 0u ? x - 7u : x << 2;
  if (x % 16u < 5u) {
    v = v.x > 3.0 ? v * 2.0 + 1.0 : -v;
    if (v.y < 0.0) v.z = sqrt(v.x * v.x + 1.0);
    else if (v.z != v.z) v = vec3(0.25);
  }
  for (uint k = 0u; k < (x & 15u); k++) {
    if ((y & k) != 0u) y += k * 5u;
    else y ^= x > 9u && y + k > 77u ? 0x55u : v.x < 1.0 || k * y < 8u ? y >> 3 : 1u;
  }
  if (v.x < 2.0) y = ~y;
  data[i] = y ^ floatBitsToUint(v.x + v.y) ^ floatBitsToUint(v.z != v.z ? 1.0 : v.z * 0.5);
)";

}  // namespace

TEST_CASE("selections that only choose a value are flattened, and every bit stays") {
  const std::vector<uint32_t> strict = gpu::decorate_no_contraction(word_kernel(choosing));
  constexpr uint32_t numbers = 4096;
  std::vector<uint32_t> words(numbers), results[2];
  for (uint32_t i = 0; i < numbers; ++i) words[i] = i < 1024 ? i : i * 2654435761u;
  for (const bool flat : {false, true}) {
    const std::vector<uint32_t> spirv = flat ? gpu::optimise(strict, true) : strict;
    CHECK((count(spirv, spv::OpSelectionMerge) == 0) == flat);
    CHECK(spvtools::SpirvTools(SPV_ENV_VULKAN_1_1).Validate(spirv));
    gpu::Kernel kernel(device(), gpu::set_float_modes(spirv, device().info().float_modes), "bits", no_cache);
    gpu::Buffer data(device(), words.size() * 4, "data");
    data.upload_records(words);
    kernel.set_buffer(0, data);
    gpu::dispatch(device(), kernel, {}, {numbers / 64});
    results[flat] = data.read_records<uint32_t>(words.size());
  }
  CHECK(results[0] != words);
  CHECK(results[0] == results[1]);
}

TEST_CASE("operations that have an effect, or may fault, run only where they are needed") {
  CHECK(left_of("uint x = data[0]; if (x > 3u) x = x * 2u; data[i] = x;") == 0);
  CHECK(left_of("uint x = data[0]; if (x > 3u) data[1] = 2u; data[i] = x;") == 1);  // a store
  CHECK(left_of("uint x = data[0]; if (x < 9u) x = data[x]; data[i] = x;") == 1);   // a load
  CHECK(left_of("uint x = data[0]; if (x != 0u) x = i / x; data[i] = x;") == 1);    // a division
  CHECK(left_of("uint x = data[0]; if (x != 0u) atomicAdd(data[1], x); data[i] = x;") == 1);
  // In glslang 12's code, modf writes the whole part through a pointer. In glslang 15's, it returns a
  // structure, which is a mere value.
  const std::string parts =
      "float x = float(data[0]), w = 1.0; if (x > 3.0) x = modf(x, w); data[i] = uint(x + w);";
  CHECK(left_of(parts) == (writes_whole_part(word_kernel(parts)) ? 1 : 0));
}

TEST_CASE("words that are not SPIR-V are not flattened") {
  CHECK(error_of([] { gpu::flatten_selections(std::vector<uint32_t>{1, 2, 3}); }).second ==
        ExitCode::bad_input);
}
