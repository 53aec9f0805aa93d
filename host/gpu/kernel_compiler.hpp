// From GLSL to a kernel's SPIR-V: compiled, with the float policy, optimised, and remembered.
#pragma once

#include <optional>
#include <string_view>

#include "host/core/disk_cache.hpp"
#include "host/gpu/device.hpp"
#include "host/gpu/shader_compiler.hpp"

namespace eyeray::engine::gpu {

struct KernelOptions {
  std::optional<FloatModes> strict = {};  // the float policy, with these modes; none: --fast-math
  bool optimise = true;                   // spirv_optimiser.hpp
  bool flatten = false;                   // the same; only where `optimise`
  bool validate = false;                  // checks the result by SPIRV-Tools' validator, as spirv-val does
};

// Error (bad_input) where the result is not valid. Else: the result of compile_shader and `options`, or the
// earlier result of the same text and preamble. A shader with warnings is compiled every time, so that
// they are seen every time.
CompiledShader compile_kernel(const ShaderSource& source, std::string_view preamble,
                              const KernelOptions& options, const DiskCache& cache);

}  // namespace eyeray::engine::gpu
