// Kernels that call functions of their own for division and square root, where the device's are not correctly
// rounded. This is done once, after glslang, on the SPIR-V itself.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace eyeray::engine::gpu {

// The module with calls of the functions PREFIX_quotient(a, b) and PREFIX_root(a) instead of each division
// and square root of float32, by component. In functions whose names begin with PREFIX or `worst` they stay.
// The prefix is `exact` (shaders/math/exact.glsl), or, after that, `worst` (shaders/math/worst.glsl). `spirv`
// has names, and both functions, with constant parameters. Error (bad_input) if it uses an operation whose
// result Vulkan leaves to the device: GLSL's dot, mod, fma, min, normalize, exp and the like, or matrices.
std::vector<uint32_t> call_for_arithmetic(std::span<const uint32_t> spirv, std::string_view prefix);

}  // namespace eyeray::engine::gpu
