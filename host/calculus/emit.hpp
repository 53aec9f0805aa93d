// What straight-line code computes, as text in the common subset of GLSL and C++.
#pragma once

#include <string>

#include "calculus/tape.hpp"

namespace eyeray::calculus {

// vec3 NAME(vec3 x, vec3 y, vec3 z): encloses the function along a ray; needs shaders/enclosure.glsl.
std::string enclosure_text(const StraightLine& line, std::string_view name);

// vec4 NAME(vec3 p): the function's gradient and, in w, its value; needs shaders/dual.glsl.
std::string gradient_text(const StraightLine& line, std::string_view name);

// How far the constant, as a float, may be from what was meant.
float constant_error(const Step& step);

}  // namespace eyeray::calculus
