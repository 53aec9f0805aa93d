// A formula as GLSL for kernels. Private to this layer.
#pragma once

#include <string>

#include "host/expression/loaded_numbers.hpp"
#include "host/formula/entry.hpp"
#include "host/formula/ir.hpp"

namespace eyeray::engine::formula {

// The functions entry_of(kind) and, if the program has it, other_entry_of(kind), with `name` before their
// names, and the functions that they call. They need shaders/math/formula.glsl and, where loops are counted,
// `bool formula_iterates(uint)`. Each statement is one operation on numbers: nothing of the user's text is
// left, and nothing for a compiler to fold. With `numbers`, constants are loaded, except indices into arrays.
std::string kernel_text(const ir::Program& program, FormulaKind kind, const std::string& name,
                        expression::LoadedNumbers* numbers = nullptr);

}  // namespace eyeray::engine::formula
