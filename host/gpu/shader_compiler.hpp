// GLSL to SPIR-V 1.3 for Vulkan 1.1, in this process, by glslang.
#pragma once

#include <cstdint>
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

// Compiles a shader, of the stage that its entry's name gives (NAME.vert.glsl, NAME.frag.glsl, else a compute
// shader), with `preamble` (#define lines) before its first line. InputError with everything that is wrong,
// at its file, line and column (0 when the message names nothing that can be found in the line).
CompiledShader compile_shader(const ShaderSource& source, std::string_view preamble,
                              Lines lines = Lines::dropped);

// A name of everything that the result depends on besides source and preamble.
std::string compiler_version();

}  // namespace eyeray::engine::gpu
