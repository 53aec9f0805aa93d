// Replaces branches that only choose a value by instructions that choose it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace eyeray::engine::gpu {

// The module with flattened selections: both arms are computed if neither has a side effect or can fault, and
// OpSelect replaces the OpPhi behind them. Selections within such arms are flattened first. Variables should
// be in registers before (SPIRV-Tools' ssa-rewrite). Every result has the same bits. Error (bad_input) if the
// module is not SPIR-V.
std::vector<uint32_t> flatten_selections(std::span<const uint32_t> spirv);

}  // namespace eyeray::engine::gpu
