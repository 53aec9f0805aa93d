// What a tape computes, as text in the common subset of GLSL and C++.
#pragma once

#include <string>

#include "derive/tape.hpp"

namespace eyeray::derive {

// vec3 NAME(vec3 x, vec3 y, vec3 z): encloses the function along a ray; needs shaders/enclosure.glsl.
std::string enclosure_text(const Tape& tape, Term result, std::string_view name);

// vec4 NAME(vec3 p): the function's gradient and, in w, its value; needs shaders/dual.glsl.
std::string gradient_text(const Tape& tape, Term result, std::string_view name);

}  // namespace eyeray::derive
