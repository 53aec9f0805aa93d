// A formula's text in the languages that run it. Private to this layer.
#pragma once

#include <string>
#include <vector>

#include "formula/program.hpp"

namespace eyeray::formula {

// Where a token of the translation stands in the original; both from 1.
struct Place {
  int line, column;  // of the translation
  int source_line, source_column;
};

struct Translation {
  std::string text;  // its lines are those of the original
  std::vector<Place> places;
};

// With `prefix` before every name of the text's own.
// For people to be told what is wrong with it: everything else as written.
Translation checked_glsl(const Program& program, const std::string& prefix);
// For kernels. Literals are not folded by the compiler of GLSL, which would compute in float64; loops are
// counted by `formula_turn()`.
Translation kernel_glsl(const Program& program, const std::string& prefix);
// For the C++ of cpp_language.hpp; loops are counted by `turn()`.
Translation cpp(const Program& program, const std::string& prefix);

// A literal for `value` that glslang does not fold.
std::string unfolded(float value);

}  // namespace eyeray::formula
