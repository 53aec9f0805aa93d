// What SPIR-V's instructions that compute mean on a tape. Private to this layer.
#pragma once

#include <optional>
#include <vector>

#include <glslang/SPIRV/spirv.hpp>

#include "calculus/tape.hpp"

namespace eyeray::formula {

using calculus::no_term;
using calculus::Op;
using calculus::Tape;
using calculus::Term;

// The numbers of a vector, matrix, array or struct, flat; matrices by columns.
using Value = std::vector<Term>;

// A core instruction's result of `size` numbers, or nothing for one that is not known here, or that is for
// constants alone and got others.
std::optional<Value> arithmetic(Tape& tape, spv::Op op, const std::vector<Value>& from, size_t size);

// The same for whole numbers. Beside comparisons only what is known beforehand can be computed with, since
// the rest would wrap around.
std::optional<Value> whole_arithmetic(Tape& tape, spv::Op op, const std::vector<Value>& from, bool is_signed);

// One of GLSL's functions (GLSL.std.450), likewise.
std::optional<Value> glsl_function(Tape& tape, uint32_t function, const std::vector<Value>& from);

Term dot(Tape& tape, const Value& a, const Value& b);
Term truncate(Tape& tape, Term x);

}  // namespace eyeray::formula
