// The words of GLSL that a formula may use. Private to this layer.
#pragma once

#include <span>
#include <string_view>

namespace eyeray::engine::formula {

// float, vec3, int …
bool is_type(std::string_view word);
// if, for, return, const …
bool is_keyword(std::string_view word);
// True for words of GLSL that a formula cannot use: uniform, mat3, switch …
bool is_refused(std::string_view word);
// sin, dot …: the functions that shaders/math/formula.glsl has as fn_sin, fn_dot …
std::span<const std::string_view> built_in_functions();
bool is_built_in(std::string_view word);
// xyz, r, stp …: one to four letters of one of the sets xyzw, rgba, stpq.
bool is_swizzle(std::string_view word);

}  // namespace eyeray::engine::formula
