#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("specialization constants decide the local size, arrays and values") {
  const KernelFolder folder(
      "layout(constant_id = 3) const uint SIDE = 4; layout(constant_id = 4) const bool NEGATE = false;\n"
      "layout(local_size_x = 4, local_size_x_id = 3) in; layout(constant_id = 5) const float SCALE = 1.0; "
      "layout(std430, binding = 0) buffer B { float b[]; }; shared float list[SIDE * 2 + 1];",
      "uint i = gl_LocalInvocationID.x; list[i] = SCALE; barrier();\n"
      "b[i] = float(NEGATE ? -1 : 1) * list[SIDE - 1 - i] * float(gl_WorkGroupSize.x + list.length());",
      "");
  CHECK(folder.job().local_size[0] == 4);
  CHECK(records<float>(folder.emulated().buffers[0]) == std::vector<float>(4, 13.0f));
  const std::vector<std::string> more = {"constants.SIDE=2", "constants.4=true", "constants.SCALE=0.5"};
  CHECK(folder.job(more).local_size[0] == 2);
  CHECK(records<float>(folder.emulated(more).buffers[0]) == std::vector<float>(2, -3.5f));
  CHECK(compute::run(folder.job(more), {}).buffers == folder.emulated(more).buffers);
}

TEST_CASE("push constants, uniform buffers and several sets get their values") {
  const KernelFolder folder(
      "layout(local_size_x = 2) in; struct Pair { vec3 a; float b; };\n"
      "layout(std430, set = 2, binding = 9) buffer B { float b[]; };"
      "layout(std140, set = 1, binding = 9) uniform U { float list[2]; Pair pairs[2]; mat2 m; };"
      "layout(push_constant) uniform Push { vec2 v; layout(offset = 16) Pair p; int n; };",
      "uint i = gl_LocalInvocationID.x; b[i] = list[i] + 10 * pairs[i].b + 100 * pairs[i].a.z + v[i] + p.b + "
      "float(n) + m[1][i];",
      "[push]\nv = [0.5, 0.25]\np = { a = [1, 2, 3], b = 1000 }\nn = -2\n"
      "[buffer.U]\nvalues = { list = [1, 2], pairs = [{ b = 3 }, { a = [0, 0, 4], b = 5 }], m = [0, 0, 7, 8] "
      "}\n");
  const std::vector<float> wanted = {1 + 30 + 0.5f + 1000 - 2 + 7, 2 + 50 + 400 + 0.25f + 1000 - 2 + 8};
  CHECK(records<float>(folder.emulated().buffers[1]) == wanted);
  CHECK(records<float>(compute::run(folder.job(), {}).buffers[1]) == wanted);
  CHECK(folder.job().warnings.empty());
  CHECK(folder.job({"push={n=1}"}).warnings.at(0).message ==
        "the push constants are 0: v, p, since [push] is not set");
}

TEST_CASE("a run-time array is as long as its values, its key or the dispatch") {
  const KernelFolder folder(
      "layout(local_size_x = 4, local_size_y = 2) in;\n"
      "layout(std430, binding = 0) buffer B { uint n; vec2 b[]; };",
      "", "groups = [3, 2]\n");
  const auto bytes = [&](const std::vector<std::string>& overrides) {
    return folder.job(overrides).buffers[0].bytes.size();
  };
  CHECK(bytes({}) == 8 + 48 * 8);
  CHECK(bytes({"buffer.B.elements=5"}) == 8 + 5 * 8);
  CHECK(bytes({"buffer.B.bytes=24"}) == 24);
  CHECK(bytes({"buffer.B.values={n=7,b=[[1,2],[3,4],[5,6]]}"}) == 8 + 3 * 8);
  CHECK(bytes({"buffer.B.values={b=[1,2,3,4]}"}) == 8 + 2 * 8);
}

TEST_CASE("noise is the same everywhere, and fills what nothing sets") {
  const KernelFolder folder(two_buffers + "layout(std430, binding = 2) writeonly buffer W { uint w[]; };", "",
                            "");
  const compute::Job job = folder.job();
  const auto source = records<float>(job.buffers[0].bytes);
  REQUIRE(source.size() == 64);
  CHECK(source[0] == 0.5665615200996399f);
  CHECK(source[1] == 0.7457817196846008f);
  CHECK(job.buffers[0].bytes != job.buffers[1].bytes);
  CHECK(records<uint32_t>(job.buffers[2].bytes) == std::vector<uint32_t>(64));
  for (const float each : source) CHECK((each >= 0 && each < 1));
  const auto dice =
      records<float>(folder.job({"buffer.Source.noise={seed=2,from=-1,to=1}"}).buffers[0].bytes);
  CHECK(*std::ranges::min_element(dice) < -0.8f);
  CHECK(*std::ranges::max_element(dice) > 0.8f);
}

TEST_CASE("SPIR-V with several entry points and old-style buffers runs") {
  const KernelFolder folder("", "", "");
  const std::string text = R"(OpCapability Shader
OpMemoryModel Logical GLSL450
OpEntryPoint GLCompute %one "one"
OpEntryPoint GLCompute %two "two"
OpExecutionMode %one LocalSize 1 1 1
OpExecutionMode %two LocalSize 1 1 1
OpName %A "A"
OpDecorate %A BufferBlock
OpMemberDecorate %A 0 Offset 0
OpDecorate %a DescriptorSet 3
OpDecorate %a Binding 1
%void = OpTypeVoid
%fn = OpTypeFunction %void
%uint = OpTypeInt 32 0
%A = OpTypeStruct %uint
%pA = OpTypePointer Uniform %A
%p = OpTypePointer Uniform %uint
%a = OpVariable %pA Uniform
%zero = OpConstant %uint 0
%five = OpConstant %uint 5
%six = OpConstant %uint 6
%one = OpFunction %void None %fn
%l1 = OpLabel
%p1 = OpAccessChain %p %a %zero
OpStore %p1 %five
OpReturn
OpFunctionEnd
%two = OpFunction %void None %fn
%l2 = OpLabel
%p2 = OpAccessChain %p %a %zero
OpStore %p2 %six
OpReturn
OpFunctionEnd
)";
  write_text(folder.path() / "k.spvasm", text);
  REQUIRE(run_process({"spirv-as", "--target-env", "vulkan1.1", folder / "k.spvasm", "-o", folder / "k.spv"})
              .code == 0);
  const auto result = [&](const std::string& entry, bool emulated) {
    compute::RunOptions how;
    how.device.emulate = emulated;
    return records<uint32_t>(
        compute::run(compute::load_job(folder / "k.spv", {"entry=" + entry}), how).buffers[0])[0];
  };
  CHECK(result("one", true) == 5);
  CHECK(result("two", true) == 6);
  CHECK(result("two", false) == 6);
  CHECK(contains(folder.refusal({"kernel=" + (folder / "k.spv")}),
                 "k.spv has the entry points one, two: name one of them by `entry`"));
  CHECK(contains(folder.refusal({"kernel=" + (folder / "k.spv"), "entry=three"}), "not \"three\""));
}

TEST_CASE("numbers of 8, 16 and 64 bits run on the device and in the emulator") {
  const KernelFolder folder(
      "#extension GL_EXT_shader_explicit_arithmetic_types : require\n" + lines64 +
          "layout(std430, binding = 0) buffer B { uint64_t b[]; }; layout(std430, binding = 1) buffer D { "
          "double d[]; }; layout(std430, binding = 2) buffer S { int16_t s[]; };",
      "uint i = gl_GlobalInvocationID.x; b[i] = b[i] << 40; d[i] = d[i] / 3.0; s[i] = s[i] * int16_t(-3);",
      "[buffer.S]\nvalues = [1, -2, 3]\nelements = 64\n");
  CHECK(contains(folder.refusal(), "this list has 3 values, but int16[64] has 64"));
  const std::vector<std::string> noise = {"buffer.S={noise={from=-100,to=100},elements=64}"};
  const compute::Outcome emulated = folder.emulated(noise);
  CHECK(emulated.buffers == compute::run(folder.job(noise), {}).buffers);
  CHECK(records<double>(emulated.buffers[1])[5] ==
        records<double>(folder.job(noise).buffers[1].bytes)[5] / 3);
}
