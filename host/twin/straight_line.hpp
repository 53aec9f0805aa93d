// Straight-line code, run step by step by the shaders' own functions: to the last bit as the text made of it
// (expression/emit.hpp), and without a compiler.
#pragma once

#include "host/expression/expression.hpp"
#include "shaders/language.h"

namespace eyeray::engine::twin {

// By math/affine_bound.glsl, of coordinates bounded along a ray.
shader::vec3 affine_bound(const expression::StraightLine& line, const shader::vec3& x, const shader::vec3& y,
                          const shader::vec3& z);

// By math/dual.glsl: gradient and value.
shader::vec4 differentiate(const expression::StraightLine& line, const shader::vec3& p);

}  // namespace eyeray::engine::twin
