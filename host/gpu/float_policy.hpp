// Sets the behaviour of floats in a kernel, unless the user chooses --fast-math. This is done once, after
// glslang, on the SPIR-V itself.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/gpu/device.hpp"

namespace eyeray::engine::gpu {

// True for the arithmetic instructions (SPIR-V 3.42.13) with a float result.
bool is_float_arithmetic(uint32_t opcode);

// The module with NoContraction on every float arithmetic result, so that no driver fuses or re-associates:
// each operation rounds once, as in the twin. (glslang's `precise` does not reach into called functions, and
// never decorates OpDot.)
std::vector<uint32_t> decorate_no_contraction(std::span<const uint32_t> spirv);

// The module with the float32 execution modes of `modes` on its entry points (SPV_KHR_float_controls).
std::vector<uint32_t> set_float_modes(std::span<const uint32_t> spirv, const FloatModes& modes);

}  // namespace eyeray::engine::gpu
