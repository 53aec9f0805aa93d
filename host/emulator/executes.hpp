// The functions that execute instructions; null for an instruction that the emulator does not have. Private
// to this layer.
#pragma once

#include "host/emulator/program.hpp"

namespace eyeray::engine::emulator {

// Arithmetic, comparisons, conversions, bits: word by word.
Execute arithmetic(spv::Op op);
// Products of vectors and matrices, and components whose index is computed.
Execute vector_operation(spv::Op op);
// The functions of GLSL.std.450.
Execute glsl_function(uint32_t function);
// OpGroupNonUniform…. `literals`: of arithmetic: the operation and, if clustered, the cluster's size.
Execute subgroup_operation(spv::Op op);
// Loads, stores, atomics, access chains, texels, barriers.
Execute memory_operation(spv::Op op);
// Concatenates the words of all operands.
void concatenate(Group& group, const Operation& operation);

}  // namespace eyeray::engine::emulator
