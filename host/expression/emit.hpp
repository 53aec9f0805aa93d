// The steps of straight-line code, as text in the common subset of GLSL and C++.
#pragma once

#include <string>

#include "host/expression/expression.hpp"
#include "host/expression/loaded_numbers.hpp"

namespace eyeray::engine::expression {

// With `numbers`, the constants are loaded.

// vec3 NAME(vec3 x, vec3 y, vec3 z): bounds the function along a ray; needs shaders/math/affine_bound.glsl.
std::string bound_text(const StraightLine& line, std::string_view name, LoadedNumbers* numbers = nullptr);

// vec4 NAME(vec3 p): the function's gradient and, in w, its value; needs shaders/math/dual.glsl.
std::string gradient_text(const StraightLine& line, std::string_view name, LoadedNumbers* numbers = nullptr);

// The greatest distance of the constant, as a float, from its meant value.
float constant_error(const Step& step);

}  // namespace eyeray::engine::expression
