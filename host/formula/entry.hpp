// What the text of a formula defines for those who ask it.
#pragma once

#include <string_view>

namespace eyeray::formula {

enum class FormulaKind {
  surface,  // `float f(vec3 p)`, negative inside; it may have `vec3 gradient(vec3 p)` too
  color,    // `vec3 color(vec2 uv)`
};

// The function TYPE NAME(PARAMETER …).
struct Entry {
  std::string_view type, name, parameter;
};

inline constexpr Entry gradient_entry{"vec3", "gradient", "vec3"};

// The function that a text of this kind must have.
constexpr Entry entry_of(FormulaKind kind) {
  return kind == FormulaKind::surface ? Entry{"float", "f", "vec3"} : Entry{"vec3", "color", "vec2"};
}

}  // namespace eyeray::formula
