// float f(vec3 p) of a user's, as straight-line code.
#pragma once

#include <string_view>

#include "calculus/tape.hpp"
#include "core/diagnostic.hpp"

namespace eyeray::derive {

// Compiles `text`, GLSL of version 450 that defines float f(vec3 p), whose first line stands at `where`, with
// `prelude` (lines of declarations) before it. Loops are unrolled, calls inlined. InputError, at the line and
// column in `where.file` as far as they are known, for what does not compile, and for what cannot be written
// as straight-line code: loops whose number of turns depends on p without a bound, indices and whole numbers
// computed from p.
calculus::StraightLine read_function(std::string_view text, const SourcePosition& where,
                                     std::string_view prelude = "");

}  // namespace eyeray::derive
