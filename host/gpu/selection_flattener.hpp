// Branches that only choose a value, as instructions that do.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace eyeray::engine::gpu {

// The same module, with both arms of a selection computed where neither has an effect or can fault, and
// OpSelect in place of the OpPhi behind it. Selections within such arms go first. Variables are best in
// registers before (SPIRV-Tools' ssa-rewrite). Every result has the same bits. Error (bad_input) for what is
// not SPIR-V.
std::vector<uint32_t> flatten_selections(std::span<const uint32_t> spirv);

}  // namespace eyeray::engine::gpu
