// The functions that a formula's text defines for its callers.
#pragma once

#include <string_view>

namespace eyeray::engine::formula {

enum class FormulaKind {
  surface,  // `float f(vec3 p)`, negative inside; optionally `vec3 gradient(vec3 p)`
  color,    // `vec3 color(vec2 uv)`
  camera,   // `vec3 direction(vec2 place, vec2 lens)`; optionally `vec3 origin(vec2 place, vec2 lens)`
};

// A function TYPE NAME(PARAMETER …) as executors call it. `written`: its parameters in the user's text.
struct Entry {
  std::string_view type, name, parameter, written;
};

// The function that a text of this kind must have.
constexpr Entry entry_of(FormulaKind kind) {
  switch (kind) {
    case FormulaKind::surface:
      break;
    case FormulaKind::color:
      return {"vec3", "color", "vec2", "vec2 uv"};
    case FormulaKind::camera:
      return {"vec3", "direction", "vec4", "vec2 place, vec2 lens"};
  }
  return {"float", "f", "vec3", "vec3 p"};
}

// The second function that a text of this kind may have. A color has none.
constexpr Entry other_entry_of(FormulaKind kind) {
  return kind == FormulaKind::camera ? Entry{"vec3", "origin", "vec4", "vec2 place, vec2 lens"}
                                     : Entry{"vec3", "gradient", "vec3", "vec3 p"};
}

}  // namespace eyeray::engine::formula
