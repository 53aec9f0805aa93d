#include <spirv-tools/libspirv.hpp>

#include "support.hpp"

using namespace eyeray::engine;
using namespace eyeray::engine::test;

TEST_CASE("bindings, push constants, work group and member offsets come out of the SPIR-V") {
  const gpu::Reflection reflection = gpu::reflect(compile(R"(#version 450
layout(local_size_x = 8, local_size_y = 4, local_size_z = 2) in;
struct Inner { vec4 a; float b; uint c; vec2 d; };
layout(std430, binding = 7) buffer Many { Inner many[]; };
layout(std430, binding = 2) buffer Once { uint number; vec3 direction; float list[5]; mat3 turn; Inner inner[2]; } once;
layout(push_constant) uniform Push { uvec4 tile; uint sample_index; float weight; };
void main() { many[tile.x].b = once.inner[1].b + weight + once.direction.x; }
)"));
  using Bindings = std::map<uint32_t, gpu::BindingKind>;
  CHECK(reflection.bindings == Bindings{{2, gpu::BindingKind::storage}, {7, gpu::BindingKind::storage}});
  CHECK(reflection.push_constant_bytes == 24);
  CHECK(reflection.local_size == std::array<uint32_t, 3>{8, 4, 2});
  const auto describe = [&](const std::string& name) {
    std::string text;
    for (const gpu::ReflectedStruct& type : reflection.structs) {
      if (type.name != name) continue;
      text += fmt::format("{}:", type.size);
      for (const gpu::ReflectedMember& member : type.members)
        text += fmt::format(" {}@{}", member.name, member.offset);
    }
    return text;
  };
  CHECK(describe("Inner") == "32: a@0 b@16 c@20 d@24");
  CHECK(describe("Once") == "160: number@0 direction@16 list@28 turn@48 inner@96");
  CHECK(describe("Push") == "24: tile@0 sample_index@16 weight@20");
  CHECK(describe("Many") == "0: many@0");
}

TEST_CASE("a texel buffer is distinguished from a storage buffer") {
  const gpu::Reflection reflection = gpu::reflect(compile(R"(#version 450
layout(local_size_x = 1) in;
layout(rgba32ui, binding = 4) readonly uniform uimageBuffer texels;
layout(std430, binding = 1) buffer B { uvec4 x; };
void main() { x = imageLoad(texels, 3); }
)"));
  using Bindings = std::map<uint32_t, gpu::BindingKind>;
  CHECK(reflection.bindings == Bindings{{1, gpu::BindingKind::storage}, {4, gpu::BindingKind::texels}});
}

TEST_CASE("uniform buffers, and storage buffers in the way of SPIR-V 1.0, are distinguished") {
  using Bindings = std::map<uint32_t, gpu::BindingKind>;
  CHECK(gpu::reflect(compile(R"(#version 450
layout(local_size_x = 1) in;
layout(std140, binding = 3) uniform U { float other; };
layout(std430, binding = 0) buffer B { float x; };
void main() { x = other; }
)"))
            .bindings == Bindings{{0, gpu::BindingKind::storage}, {3, gpu::BindingKind::uniform}});

  std::vector<uint32_t> old_style;
  REQUIRE(spvtools::SpirvTools(SPV_ENV_VULKAN_1_1)
              .Assemble(R"(OpCapability Shader
OpMemoryModel Logical GLSL450
OpDecorate %block BufferBlock
OpMemberDecorate %block 0 Offset 0
OpDecorate %data DescriptorSet 0
OpDecorate %data Binding 2
%float = OpTypeFloat 32
%block = OpTypeStruct %float
%pointer = OpTypePointer Uniform %block
%data = OpVariable %pointer Uniform
)",
                        &old_style));
  CHECK(gpu::reflect(old_style).bindings == Bindings{{2, gpu::BindingKind::storage}});
}

TEST_CASE("a shader may bind only buffers, and texel buffers of one format, in set 0") {
  const auto refused = [](const std::string& declaration) {
    return error_of([&] {
             gpu::reflect(compile(
                 "#version 450\nlayout(local_size_x = 1) in;\n" + declaration +
                 "\nlayout(std430, binding = 0) buffer B { float x; };\nvoid main() { x = other; }\n"));
           })
        .first;
  };
  CHECK(contains(refused("layout(std430, set = 1, binding = 0) buffer U { float other; };"),
                 "at set 1, binding 0"));
  CHECK(contains(
      refused("layout(r32f, binding = 5) uniform imageBuffer t;\nfloat load() { return imageLoad(t, 0).x; }\n"
              "#define other load()"),
      "at set 0, binding 5"));
  CHECK(refused("const float other = 1.0;") == "");
}
