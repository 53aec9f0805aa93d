#pragma once

#include "host/scene/shape.hpp"

namespace eyeray::shapes {

// Every kind of shape, in registry order: the order of Scene::shapes, hence of primitive indices.
std::span<const ShapeType* const> types();

}  // namespace eyeray::shapes
