// The order of a function's blocks in which invocations reconverge. Private to this layer.
#pragma once

#include <vector>

#include "host/spirv/module.hpp"

namespace eyeray::engine::emulator {

// Labels of the blocks that the function's first one reaches, in structured order: each construct comes
// before its merge block, and a loop's body before its continue block. "Structured order" is that of
// SPIRV-Tools' cfg.h: reverse post-order, where a header's merge block and continue target count as its first
// successors.
std::vector<uint32_t> structured_order(const spirv::Function& function);

// The labels to which the block's last instruction may go.
std::vector<uint32_t> successors(const spirv::Instruction& terminator);

}  // namespace eyeray::engine::emulator
