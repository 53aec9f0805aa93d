// What makes C++ read as the GLSL of formulas. Private to this layer.
#pragma once

#include <string>
#include <string_view>

namespace eyeray::formula {

// A translation unit without any #include that exports
//   extern "C" int eyeray_f32(float x, float y, float z, float* value)
//   extern "C" int eyeray_f64(double x, double y, double z, double* value)
//   extern "C" int eyeray_gradient_f32(float x, float y, float z, float* gradient)     if it has one
// which return 0, or 1 where the formula's loops made too many turns. float32 has the shaders' own functions
// (formula.glsl), so that the bits are the GPU's; float64 those of C's library. `constants32`, `constants64`
// and `program`: what translation.hpp makes of the parameters and the text, with the prefix u_.
std::string cpp_unit(std::string_view constants32, std::string_view constants64, std::string_view program,
                     bool has_gradient);

// Its parts over a type `real`: numbers and vectors; and, for float64, the built-in functions.
std::string_view cpp_types();
std::string_view cpp_functions();

}  // namespace eyeray::formula
