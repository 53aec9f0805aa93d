// Runs SPIRV-Tools' passes over a module once, which a driver would otherwise do at every start.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace eyeray::engine::gpu {

// The module with functions inlined, variables in registers where possible, and code without effect removed.
// Every result has the same bits: arithmetic decorated NoContraction is not folded. A module that inlining
// would make twice as large as our largest, or that the passes cannot process, is returned unchanged. Error
// (bad_input) if the module is not SPIR-V.
//
// The passes know no float modes and leave a module that declares some nearly as it is; so those come after
// them.
//
// `flatten`: selections too (selection_flattener.hpp), for a driver whose compiler needs them gone.
std::vector<uint32_t> optimise(std::span<const uint32_t> spirv, bool flatten = false);

// A name of everything that the result depends on besides the module.
std::string optimiser_version(bool flatten);

}  // namespace eyeray::engine::gpu
