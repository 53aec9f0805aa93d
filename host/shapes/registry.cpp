#include "host/shapes/registry.hpp"

#include "shaders/shapes/rows.h"

namespace eyeray::engine::shapes {

// Each shape's .cpp defines its own type; a missing one causes a link error that contains its name.
#define X(name, number) extern const ShapeType name##_type;
SHAPES(X)
#undef X

#define MADE_SHAPES(X) X(blob) X(text) X(lathe) X(sphere_sweep)
#define X(name) extern const ShapeType name##_type;
MADE_SHAPES(X)
#undef X

std::span<const ShapeType* const> types() {
#define X(name, number) &name##_type,
  static constexpr const ShapeType* types[] = {SHAPES(X)};
#undef X
  return types;
}

std::span<const ShapeType* const> made_types() {
#define X(name) &name##_type,
  static constexpr const ShapeType* types[] = {MADE_SHAPES(X)};
#undef X
  return types;
}

}  // namespace eyeray::engine::shapes
