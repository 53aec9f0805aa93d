#include <numeric>

#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

std::vector<uint32_t> count_to(size_t words) {
  std::vector<uint32_t> all(words);
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

}  // namespace

TEST_CASE("a uniform buffer has std140's strides, and its matrices are in columns or in rows") {
  // Each word of the buffer is its own number.
  const How how{.declarations =
                    "struct Part { uint a; uvec3 b; }; "
                    "layout(std140, binding = 1, row_major) uniform Settings { "
                    "  uint first; "                       // word 0
                    "  uint list[3]; "                     // words 4, 8, 12
                    "  layout(column_major) mat3x2 c; "    // columns at words 16, 20, 24
                    "  mat3x2 r; "                         // rows at words 28, 32
                    "  layout(column_major) mat2 cs[2]; "  // columns at words 36, 40, 44, 48
                    "  Part parts[2]; "                    // words 52 and 60
                    "};",
                .more = {{1, count_to(68)}}};
  const Ran ran =
      run("data[0] = first; data[1] = list[i + 2u]; data[2] = floatBitsToUint(c[2][1]); "
          "data[3] = floatBitsToUint(c[i + 1u][i]); data[4] = floatBitsToUint(r[2][1]); "
          "data[5] = floatBitsToUint(r[i + 1u][i + 1u]); vec2 v = r[i + 2u]; data[6] = floatBitsToUint(v.y); "
          "mat3x2 m = r; data[7] = floatBitsToUint(m[1].y); data[8] = floatBitsToUint(cs[i + 1u][1][1]); "
          "data[9] = parts[1].a; data[10] = parts[i + 1u].b.z; Part p = parts[0]; data[11] = p.b.y;",
          std::vector<uint32_t>(12), {.local_size = 1, .declarations = how.declarations, .more = how.more});
  CHECK(ran.found() == "");
  CHECK(ran.data == std::vector<uint32_t>{0, 12, 25, 20, 34, 33, 34, 33, 49, 60, 66, 57});
}

TEST_CASE("a storage buffer of SPIR-V's first kind can be written") {
  // glslang makes such blocks for SPIR-V 1.0: storage class Uniform, decoration BufferBlock.
  const auto replaced = [](std::vector<uint32_t> spirv) {
    for (size_t at = 5; at < spirv.size(); at += spirv[at] >> 16) {
      const uint32_t opcode = spirv[at] & 0xffffu;
      if (opcode == 71 && spirv[at + 2] == 2) spirv[at + 2] = 3;   // OpDecorate Block: BufferBlock
      if (opcode == 32 && spirv[at + 2] == 12) spirv[at + 2] = 2;  // OpTypePointer StorageBuffer: Uniform
      if (opcode == 59 && spirv[at + 3] == 12) spirv[at + 3] = 2;  // OpVariable
    }
    return spirv;
  };
  const std::string text =
      "#version 450\nlayout(local_size_x = 4) in;\nlayout(binding = 0) buffer Data { uint data[]; };\n"
      "void main() { data[gl_GlobalInvocationID.x] += uint(data.length()); }\n";
  std::vector<uint32_t> data = count_to(4);
  emulator::Findings findings;
  emulator::Kernel(replaced(compile(text)), "kernel")
      .run({.buffers = {{0, std::as_writable_bytes(std::span(data))}}, .findings = &findings}, {1, 1, 1});
  CHECK(findings.all().empty());
  CHECK(data == std::vector<uint32_t>{4, 5, 6, 7});
}
