// What a driver would otherwise do at every start, done once: SPIRV-Tools' passes over a module.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace eyeray::engine::gpu {

// The same module, with functions inlined, variables that need no memory gone, and nothing left that has no
// effect. Every result has the same bits: of arithmetic decorated NoContraction nothing is folded. A module
// that inlining would make twice as large as our largest, or that the passes cannot take, comes back as it
// was. Error (bad_input) for what is not SPIR-V.
//
// The passes know no float modes and leave a module that declares some nearly as it is; so those come after
// them.
//
// `flatten`: selections too (selection_flattener.hpp), for a driver whose compiler needs them gone.
std::vector<uint32_t> optimise(std::span<const uint32_t> spirv, bool flatten = false);

// What the result depends on besides the module.
std::string optimiser_version(bool flatten);

}  // namespace eyeray::engine::gpu
