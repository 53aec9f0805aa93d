// GLSL or HLSL to SPIR-V 1.3 for Vulkan 1.1, in this process, by glslang.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/gpu/shader_source.hpp"

namespace eyeray::engine::gpu {

struct CompiledShader {
  std::vector<uint32_t> spirv;
  std::vector<Diagnostic> warnings;
};

// The choice to drop or keep the file and line of each instruction in the SPIR-V.
enum class Lines { dropped, kept };

// Compiles a shader, with `preamble` (#define lines) before its first line. The entry's name gives the stage:
// NAME.vert.glsl, NAME.frag.glsl, else a compute shader. NAME.hlsl is HLSL, and `entry_point` its function;
// registers t, u and s begin at binding 100, 200 and 300. InputError with every fault, at its file, line and
// column (0 when the message names nothing that can be found in the line).
CompiledShader compile_shader(const ShaderSource& source, std::string_view preamble,
                              Lines lines = Lines::dropped, const std::string& entry_point = "main");

// Identifies everything, besides source and preamble, on which the result depends.
std::string compiler_version();

}  // namespace eyeray::engine::gpu
