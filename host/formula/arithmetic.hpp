// Translates SPIR-V's arithmetic instructions to operations of an expression. Private to this layer.
#pragma once

#include <optional>
#include <vector>

#include <spirv/unified1/spirv.hpp>

#include "host/expression/expression.hpp"

namespace eyeray::engine::formula {

using expression::Expression;
using expression::no_term;
using expression::Op;
using expression::Term;

// The numbers of a vector, matrix, array or struct, in a flat list; matrices column by column.
using Value = std::vector<Term>;

// The result of a core instruction, of `size` numbers; nothing for an instruction that is not known here.
std::optional<Value> arithmetic(Expression& expression, spv::Op op, const std::vector<Value>& from,
                                size_t size);

// The result of an instruction on whole numbers. Except for comparisons, operands must be constants, since
// other numbers would wrap around. Nothing for other operands, and for an instruction that is not known here.
std::optional<Value> whole_arithmetic(Expression& expression, spv::Op op, const std::vector<Value>& from,
                                      bool is_signed);

// The result of a GLSL function (GLSL.std.450); nothing for a function that is not known here.
std::optional<Value> glsl_function(Expression& expression, uint32_t function, const std::vector<Value>& from);

Term dot(Expression& expression, const Value& a, const Value& b);
Term truncate(Expression& expression, Term x);

}  // namespace eyeray::engine::formula
