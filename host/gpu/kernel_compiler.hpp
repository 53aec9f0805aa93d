// Turns GLSL into a kernel's SPIR-V: compiled, with the float policy, optimised, and cached.
#pragma once

#include <optional>
#include <string_view>

#include "host/core/disk_cache.hpp"
#include "host/core/embedded_file.hpp"
#include "host/gpu/device.hpp"
#include "host/gpu/shader_compiler.hpp"
#include "host/gpu/worst_device.hpp"

namespace eyeray::engine::gpu {

struct KernelOptions {
  std::optional<FloatModes> strict = {};  // the float policy, with these modes; none: --fast-math
  bool optimise = true;                   // run the passes of spirv_optimiser.hpp
  bool flatten = false;                   // flatten selections, too; only if `optimise`
  bool exact = false;                     // corrects division and square root; only if `strict`
  WorstDevice worst = {};  // for tests: simulates a device that keeps no more than Vulkan promises
  Lines lines = Lines::dropped;
  bool validate = false;  // checks the result by SPIRV-Tools' validator, as spirv-val does
};

// The source files of this layer. Their code decides the SPIR-V of a shader.
std::span<const EmbeddedFile> own_sources();

// The result of compile_shader and `options`, or the earlier result of the same text and preamble, by the
// same sources of this layer, from the cache. Error (bad_input) if the result is not valid. A shader with
// warnings is compiled every time, so that they are seen every time.
CompiledShader compile_kernel(const ShaderSource& source, std::string_view preamble,
                              const KernelOptions& options, const DiskCache& cache);

}  // namespace eyeray::engine::gpu
