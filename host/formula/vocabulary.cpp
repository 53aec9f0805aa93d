#include "host/formula/vocabulary.hpp"

#include <algorithm>

namespace eyeray::engine::formula {

namespace {

constexpr std::string_view types[] = {"void", "bool", "int", "uint", "float", "vec2", "vec3", "vec4"};
constexpr std::string_view keywords[] = {"if",   "else",  "for",   "while", "break", "continue", "return",
                                         "true", "false", "const", "in",    "out",   "inout"};
constexpr std::string_view refused[] = {
    "struct",   "switch",    "case",     "default",   "do",      "discard",   "uniform",   "buffer",
    "shared",   "attribute", "varying",  "layout",    "flat",    "smooth",    "precise",   "invariant",
    "centroid", "patch",     "sample",   "highp",     "mediump", "lowp",      "precision", "coherent",
    "volatile", "restrict",  "readonly", "writeonly", "double",  "dvec2",     "dvec3",     "dvec4",
    "ivec2",    "ivec3",     "ivec4",    "uvec2",     "uvec3",   "uvec4",     "bvec2",     "bvec3",
    "bvec4",    "mat2",      "mat3",     "mat4",      "mat2x2",  "mat2x3",    "mat2x4",    "mat3x2",
    "mat3x3",   "mat3x4",    "mat4x2",   "mat4x3",    "mat4x4",  "sampler2D", "image2D",   "subroutine"};
constexpr std::string_view functions[] = {
    "abs",         "sign",    "floor",    "ceil",      "trunc", "round",  "fract", "sqrt",
    "inversesqrt", "radians", "degrees",  "sin",       "cos",   "tan",    "asin",  "acos",
    "atan",        "exp",     "log",      "exp2",      "log2",  "pow",    "sinh",  "cosh",
    "tanh",        "min",     "max",      "mod",       "step",  "clamp",  "mix",   "smoothstep",
    "dot",         "length",  "distance", "normalize", "cross", "reflect"};

template <typename List>
bool holds(const List& list, std::string_view word) {
  return std::ranges::find(list, word) != std::end(list);
}

}  // namespace

bool is_type(std::string_view word) {
  return holds(types, word);
}
bool is_keyword(std::string_view word) {
  return holds(keywords, word);
}
bool is_refused(std::string_view word) {
  return holds(refused, word);
}
std::span<const std::string_view> built_in_functions() {
  return functions;
}
bool is_built_in(std::string_view word) {
  return holds(functions, word);
}
bool is_swizzle(std::string_view word) {
  if (word.empty() || word.size() > 4) return false;
  return std::ranges::any_of(
      std::initializer_list<std::string_view>{"xyzw", "rgba", "stpq"},
      [&](std::string_view set) { return word.find_first_not_of(set) == std::string_view::npos; });
}

}  // namespace eyeray::engine::formula
