// Runs SPIRV-Tools' passes over a module once; otherwise a driver would do that work at every start.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace eyeray::engine::gpu {

// The module with functions inlined, variables in registers where possible, and code without effect removed.
// Every result has the same bits: arithmetic decorated NoContraction is not folded. A module is returned
// unchanged if inlining would make it twice as large as our largest one, or if the passes cannot process it.
// Error (bad_input) if the module is not SPIR-V.
//
// The passes know no float modes, and leave a module that declares some nearly unchanged. So float modes are
// set after the passes.
//
// `flatten`: flattens selections too (selection_flattener.hpp), for a driver whose compiler needs that.
std::vector<uint32_t> optimise(std::span<const uint32_t> spirv, bool flatten = false);

// Identifies everything, besides the module, on which the result depends.
std::string optimiser_version(bool flatten);

}  // namespace eyeray::engine::gpu
