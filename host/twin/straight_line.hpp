// Straight-line code, run step by step by the shaders' own functions: to the last bit what the text made of
// it (calculus/emit.hpp) computes, and without a compiler.
#pragma once

#include "calculus/tape.hpp"
#include "language.h"

namespace eyeray {

// By enclosure.glsl, of coordinates enclosed along a ray.
shader::vec3 enclose(const calculus::StraightLine& line, const shader::vec3& x, const shader::vec3& y,
                     const shader::vec3& z);

// By dual.glsl: gradient and value.
shader::vec4 differentiate(const calculus::StraightLine& line, const shader::vec3& p);

}  // namespace eyeray
