// The steps of straight-line code, as text in the common subset of GLSL and C++.
#pragma once

#include <string>

#include "host/expression/expression.hpp"
#include "host/expression/loaded_numbers.hpp"

namespace eyeray::engine::expression {

// Both functions load their constants from a buffer if `numbers` is given (loaded_numbers.hpp).

// vec3 NAME(vec3 x, vec3 y, vec3 z): bounds the function along a ray; needs shaders/math/affine_bound.glsl.
std::string bound_text(const StraightLine& line, std::string_view name, LoadedNumbers* numbers = nullptr);

// vec4 NAME(vec3 p): the function's gradient and, in w, its value; needs shaders/math/dual.glsl.
std::string gradient_text(const StraightLine& line, std::string_view name, LoadedNumbers* numbers = nullptr);

// The greatest distance between the constant's float and the exact value that it stands for.
float constant_error(const Step& step);

}  // namespace eyeray::engine::expression
