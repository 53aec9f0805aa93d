// Straight-line code, run step by step by the shaders' own functions: it has the same bits as the text
// made of it (expression/emit.hpp), and needs no compiler.
#pragma once

#include "host/expression/expression.hpp"
#include "shaders/language.h"

namespace eyeray::engine::twin {

// The affine bound by math/affine_bound.glsl, for coordinates bounded along a ray.
shader::vec3 affine_bound(const expression::StraightLine& line, const shader::vec3& x, const shader::vec3& y,
                          const shader::vec3& z);

// Gradient and value by math/dual.glsl.
shader::vec4 differentiate(const expression::StraightLine& line, const shader::vec3& p);

}  // namespace eyeray::engine::twin
