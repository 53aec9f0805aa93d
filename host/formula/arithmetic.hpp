// The meaning of SPIR-V's arithmetic instructions on an expression. Private to this layer.
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

// The numbers of a vector, matrix, array or struct, flat; matrices by columns.
using Value = std::vector<Term>;

// A core instruction's result of `size` numbers, or nothing for one that is not known here, or that is for
// constants alone and got others.
std::optional<Value> arithmetic(Expression& expression, spv::Op op, const std::vector<Value>& from,
                                size_t size);

// The arithmetic of whole numbers. Beside comparisons, only constants can be computed with, since other
// numbers would wrap around.
std::optional<Value> whole_arithmetic(Expression& expression, spv::Op op, const std::vector<Value>& from,
                                      bool is_signed);

// One of GLSL's functions (GLSL.std.450), likewise.
std::optional<Value> glsl_function(Expression& expression, uint32_t function, const std::vector<Value>& from);

Term dot(Expression& expression, const Value& a, const Value& b);
Term truncate(Expression& expression, Term x);

}  // namespace eyeray::engine::formula
