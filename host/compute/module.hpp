// Changes a kernel's SPIR-V before it runs anywhere, so that a device and the emulator get the same module.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "host/compute/interface.hpp"

namespace eyeray::engine::compute {

// Error (bad_input), with the validator's reasons, if the words are no valid SPIR-V for Vulkan 1.1. `name` is
// the kernel's.
void validate(std::span<const uint32_t> spirv, const std::string& name);

// The module with `entry` as its only entry point, now called "main". Error (bad_input), with the names that
// there are, if it has no compute shader of that name. An empty `entry` is the only one.
std::vector<uint32_t> with_entry(std::span<const uint32_t> spirv, const std::string& entry,
                                 const std::string& name);

// The module with the specialization constants at the given bits, by id, or at their defaults, and then
// folded: it has none any more, and its local size is a literal.
std::vector<uint32_t> specialise(std::span<const uint32_t> spirv, const std::map<uint32_t, uint64_t>& bits);

// glslang's SPIR-V of HLSL after the passes that make it valid: functions with buffers as parameters are
// inlined.
std::vector<uint32_t> legalise(std::span<const uint32_t> spirv);

// The module with its buffers at binding 0, 1, … of set 0, in the order of the interface.
std::vector<uint32_t> in_one_set(std::span<const uint32_t> spirv, const Interface& interface);

// True if the module sets modes of floats itself (SPV_KHR_float_controls).
bool has_float_modes(std::span<const uint32_t> spirv);

// The module with other names in place of those of its source files.
std::vector<uint32_t> with_files(std::span<const uint32_t> spirv,
                                 const std::map<std::string, std::string>& shown);

}  // namespace eyeray::engine::compute
