#pragma once

#include <string_view>

#include "core/disk_cache.hpp"
#include "gpu/shader_compiler.hpp"

namespace eyeray::gpu {

// compile_shader, or what it made of the same text and preamble before. A shader with warnings is compiled
// every time, so that they are seen every time.
CompiledShader compile_shader(const ShaderSource& source, std::string_view preamble, const DiskCache& cache);

}  // namespace eyeray::gpu
