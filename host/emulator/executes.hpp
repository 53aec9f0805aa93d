// The functions that execute instructions; null for an instruction that the emulator does not have. `bits` is
// the width of the first operand's numbers. Private to this layer.
#pragma once

#include "host/emulator/program.hpp"

namespace eyeray::engine::emulator {

// Arithmetic and bits, component by component.
Execute arithmetic(spv::Op op, uint32_t bits);
Execute comparison(spv::Op op, uint32_t bits);
// Conversions between numbers of these widths.
Execute conversion(spv::Op op, uint32_t from, uint32_t to);
// `forgets`: from floats to numbers that are no such floats. `literals`: from, to, forgets.
Execute bit_cast(uint32_t from, uint32_t to, bool forgets);
// Products of vectors and matrices, and components whose index is computed.
Execute vector_operation(spv::Op op, uint32_t bits);
// The functions of GLSL.std.450.
Execute glsl_function(uint32_t function, uint32_t bits);
Execute geometric_function(uint32_t function, uint32_t bits);
Execute packing_function(uint32_t function);
// OpGroupNonUniform…. `literals`: of arithmetic: the operation and, if clustered, the cluster's size.
Execute subgroup_operation(spv::Op op, uint32_t bits);
// Loads, stores, access chains, barriers.
Execute memory_operation(spv::Op op);
// Atomics of numbers of `bits` bits.
Execute atomic_operation(spv::Op op, uint32_t bits, bool real);
// Texels of images and of texel buffers.
Execute image_operation(spv::Op op);
// Copies words to the registers from `to`.
void copy(Group& group, uint32_t to, const Source& source);
// Concatenates the words of all operands.
void concatenate(Group& group, const Operation& operation);

}  // namespace eyeray::engine::emulator
