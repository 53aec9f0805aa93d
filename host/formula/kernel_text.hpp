// A formula as GLSL for kernels. Private to this layer.
#pragma once

#include <string>

#include "host/expression/loaded_numbers.hpp"
#include "host/formula/entry.hpp"
#include "host/formula/ir.hpp"

namespace eyeray::engine::formula {

// The entry of that kind, its name behind `name`, the other one if there is one, and the functions they call;
// needs shaders/math/formula.glsl and, where loops are counted, `bool formula_iterates(uint)`. One operation
// a statement, on numbers alone: nothing of the user's text is left, and nothing for a compiler to fold. With
// `numbers`, constants are loaded, but those that are indices into arrays.
std::string kernel_text(const ir::Program& program, FormulaKind kind, const std::string& name,
                        expression::LoadedNumbers* numbers = nullptr);

}  // namespace eyeray::engine::formula
