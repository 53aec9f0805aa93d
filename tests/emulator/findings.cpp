#include <spirv-tools/libspirv.hpp>

#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

namespace {

const std::vector<uint32_t> zeros(64);
const How with_memory{.declarations = "shared uint list[64];"};

// The body's findings contain this text, at the body's line.
void check_found(const std::string& text, const Ran& ran) {
  CAPTURE(ran.found());
  CHECK(ran.found().find(text) != std::string::npos);
  CHECK(ran.found().find("kernel.comp.glsl:5 (") != std::string::npos);
}

}  // namespace

TEST_CASE("an access out of bounds is found, reads 0 and writes nothing") {
  const Ran written = run("data[i + 60u] = 7u;", zeros);
  check_found("out of bounds", written);
  CHECK(written.data[60] == 7);
  CHECK(written.data[59] == 0);
  REQUIRE(written.findings.size() == 1);
  CHECK(written.findings[0].count == 60);
  CHECK(written.findings[0].invocation[0] == 4);
  CHECK(written.findings[0].detail == "index 64 of 64 in 'Data'");
  check_found("out of bounds: index 4 of 4 in 'list', in invocation 4, 0, 0",
              run("uint list[4] = uint[4](1u, 2u, 3u, 4u); data[i] = list[i];", zeros));
  check_found(
      "index -1 of 4 in 'list', in invocation 0, 0, 0",
      run("uint list[4] = uint[4](1u, 2u, 3u, 4u); data[i] = i > 4u ? 0u : list[int(i) - 1];", zeros));
  check_found("index 64 of 64 in 'list', in invocation 63, 0, 0",
              run("list[i + 1u] = i; barrier(); data[i] = list[63u - i];", zeros, with_memory));
  CHECK(run("data[i] = data.length();", zeros).data[0] == 64);
}

TEST_CASE("a finding has the line of either kind of debug information") {
  std::vector<uint32_t> spirv;
  CHECK(spvtools::SpirvTools(SPV_ENV_VULKAN_1_1)
            .Assemble(R"(
               OpCapability Shader
               OpExtension "SPV_KHR_non_semantic_info"
       %info = OpExtInstImport "NonSemantic.Shader.DebugInfo.100"
               OpMemoryModel Logical GLSL450
               OpEntryPoint GLCompute %main "main"
               OpExecutionMode %main LocalSize 1 1 1
       %file = OpString "blur.slang"
               OpName %data "data"
               OpDecorate %list ArrayStride 4
               OpDecorate %Data Block
               OpMemberDecorate %Data 0 Offset 0
               OpDecorate %data DescriptorSet 0
               OpDecorate %data Binding 0
       %void = OpTypeVoid
     %action = OpTypeFunction %void
       %uint = OpTypeInt 32 0
       %zero = OpConstant %uint 0
       %four = OpConstant %uint 4
       %five = OpConstant %uint 5
       %list = OpTypeRuntimeArray %uint
       %Data = OpTypeStruct %list
    %pointer = OpTypePointer StorageBuffer %Data
     %number = OpTypePointer StorageBuffer %uint
       %data = OpVariable %pointer StorageBuffer
     %source = OpExtInst %void %info DebugSource %file
       %main = OpFunction %void None %action
      %start = OpLabel
       %line = OpExtInst %void %info DebugLine %source %four %four %five %five
         %to = OpAccessChain %number %data %zero %five
               OpStore %to %zero
               OpReturn
               OpFunctionEnd)",
                      &spirv));
  std::vector<uint32_t> data(2);
  emulator::Findings findings;
  emulator::Kernel(spirv, "blur")
      .run({.buffers = {{0, std::as_writable_bytes(std::span(data))}}, .findings = &findings}, {1, 1, 1});
  REQUIRE(findings.all().size() == 1);
  CHECK(describe(findings.all()[0]) ==
        "blur.slang:4:5 (OpStore): out of bounds: index 5 of 2 in 'data', in invocation 0, 0, 0 of kernel "
        "'blur'");
}

TEST_CASE("a value that was never set is found where it decides something or is stored") {
  check_found("not initialised", run("uint x; if (i > 3u) x = 5u; data[i] = x;", zeros));
  check_found("not initialised", run("uint x; data[i] = x > 3u ? 1u : 2u;", zeros));
  check_found("not initialised", run("uint x; data[x & 7u] = 1u;", zeros));
  check_found("not initialised", run("bool b; if (i > 3u) b = true; if (b) data[i] = 1u;", zeros));
  check_found("not initialised",
              run("if (i > 0u) list[i] = 1u; barrier(); data[i] = list[63u - i];", zeros, with_memory));
  // A copy, and a choice that falls on another value, are no harm.
  CHECK(run("uvec2 a; a.x = i; uvec2 b = a; data[i] = b.x;", zeros).found() == "");
  CHECK(run("uint x; if (i > 3u) x = 5u; data[i] = i > 3u ? x : 1u;", zeros).found() == "");
}

TEST_CASE("a race is found, in shared memory and in buffers") {
  check_found("race", run("list[i] = i; data[i] = list[63u - i];", zeros, with_memory));
  check_found("race", run("data[0] = i;", zeros));
  check_found("race", run("data[i] = data[(i + 1u) % 64u];", zeros));
  check_found("race", run("list[i] = i; memoryBarrierShared(); data[i] = list[i ^ 1u];", zeros, with_memory));
  check_found("race", run("data[i % 64u] = i;", zeros, {.groups = 2}));
  check_found("race", run("atomicAdd(data[0], 1u); data[i] = data[0];", zeros));
  CHECK(run("list[i] = i; barrier(); data[i] = list[63u - i];", zeros, with_memory).found() == "");
  CHECK(run("atomicAdd(data[0], i);", zeros).data[0] == 63 * 32);
  const How scoped{.declarations = "\n#extension GL_KHR_memory_scope_semantics : require\n"};
  CHECK(run("data[64u + i] = data[0] + atomicLoad(data[0], gl_ScopeDevice, gl_StorageSemanticsBuffer, "
            "gl_SemanticsRelaxed);",
            std::vector<uint32_t>(128), scoped)
            .found() == "");
  // A barrier of the subgroup orders its own invocations, and no others.
  const std::string exchange =
      "list[i] = i; subgroupMemoryBarrierShared(); subgroupBarrier(); data[i] = list[i ^ ";
  CHECK(run(exchange + "1u];", zeros, with_memory).found() == "");
  check_found("race", run(exchange + "8u];", zeros, with_memory));
}

TEST_CASE("a NaN is found where it was born, if it reaches a buffer") {
  const std::string infinity = "float inf = uintBitsToFloat(0x7f800000u); ";
  const auto nan = [&](const std::string& body) {
    return run(infinity + "float x = float(i); " + body, zeros);
  };
  const Ran born = nan("x = (x - x) / x; x = x * 2.0 + 1.0; data[i] = floatBitsToUint(x);");
  CHECK(born.found() == "");  // bits are no number
  const How reals{
      .declarations = "layout(binding = 1) buffer Reals { float reals[]; }; shared float list[64];",
      .more = {{1, zeros}}};
  const auto stored = [&](const std::string& body) {
    return run(infinity + "float x = float(i); " + body + "\nreals[i] = x;", zeros, reals);
  };
  const Ran zero = stored("x = (x - x) / x; list[i] = abs(x * 2.0 + 1.0); x = list[i];");
  check_found("(OpFDiv", zero);
  check_found(
      "not a number: 0 and 0 give NaN, which reaches 'Reals' at kernel.comp.glsl:6 (OpStore), in invocation "
      "0",
      zero);
  CHECK(zero.findings.size() == 1);
  check_found("inf and inf give NaN", stored("x = inf - inf; x = -x;"));
  check_found("-3 give NaN", stored("x = sqrt(x - 3.0);"));
  check_found("NaN, which reaches", stored("x = normalize(vec3(0) * x).x;"));
  check_found("NaN, which reaches", stored("x = dot(vec2(x, inf), vec2(1, 0));"));
  // One that is not chosen does no harm, and one that the host gave is not the kernel's. Infinities are
  // numbers.
  CHECK(stored("x = max(0.0 / x, 1.0);").found() == "");
  CHECK(stored("x = i == 0u ? 1.0 : 1.0 / x * 0.0;").found() == "");
  CHECK(stored("x = uintBitsToFloat(0x7fc12345u) + x;").found() == "");
  CHECK(stored("x = 1.0 / x;").found() == "");
}

TEST_CASE("many NaNs that are dropped do not hide one that is stored") {
  const Ran ran = run(
      "float x = 1.0; for (uint k = 0u; k < 9000u; ++k) x = max(0.0 / (x - x), x);\n"
      "reals[i] = sqrt(x - 2.0);",
      zeros, {.declarations = "layout(binding = 1) buffer Reals { float reals[]; };", .more = {{1, zeros}}});
  CHECK(ran.found().find("kernel.comp.glsl:6 (OpExtInst") != std::string::npos);
  CHECK(ran.findings.size() == 1);
  CHECK(ran.more.at(1)[5] == 0xffc00000u);
}

TEST_CASE("a NaN has the bits of the processor, whether it is watched or not") {
  const std::string body =
      "float x = float(i); x = (x - x) / x; reals[i] = i > 0u ? 1.0 : x; data[i] = floatBitsToUint(x);";
  std::vector<uint32_t> bits(64);
  const Ran ran =
      run(body + " list[0] = reals[0]; data[1] = floatBitsToUint(list[0]);", zeros,
          {.declarations = "layout(binding = 1) buffer Reals { float reals[]; }; shared float list[64];",
           .more = {{1, zeros}}});
  CHECK(ran.data[0] == 0xffc00000u);
  CHECK(ran.more.at(1)[0] == 0xffc00000u);
  CHECK(ran.data[1] == 0xffc00000u);
}

TEST_CASE("two orders of work groups and invocations show results that depend on the order") {
  const auto differ = [](const std::string& body) {
    How how{.local_size = 4, .groups = 2, .declarations = "shared uint list[4];"};
    const Ran first = run(body, std::vector<uint32_t>(16), how);
    how.order = emulator::Order::descending;
    return first.data != run(body, std::vector<uint32_t>(16), how).data;
  };
  CHECK(differ("data[1u + atomicAdd(data[0], 1u)] = i;"));
  CHECK(differ("data[0] = i;"));
  CHECK(differ("list[0] = i; barrier(); data[i] = list[0];"));
  CHECK_FALSE(differ("data[i] = i * 3u;"));
  CHECK_FALSE(differ("atomicAdd(data[0], i);"));
}

TEST_CASE("a barrier that not all invocations come to is found") {
  check_found("divergent barrier", run("if (i < 32u) barrier(); data[i] = i;", zeros));
  check_found("divergent barrier", run("for (uint k = 0u; k < i % 3u; ++k) barrier(); data[i] = i;", zeros));
  CHECK(run("for (uint k = 0u; k < 3u; ++k) barrier(); data[i] = i;", zeros).found() == "");
}

TEST_CASE("an operation on whole numbers without a result is found") {
  check_found("undefined integer", run("data[i] = 5u / i;", zeros));
  check_found("undefined integer", run("data[i] = 5u << i;", zeros));
  check_found("undefined integer", run("data[i] = uint(float(i) - 2.5);", zeros));
  check_found("undefined integer",
              run("data[i] = uint(int(data[i] - 2147483647u - 1u) / int(i - 1u));", zeros));
}
