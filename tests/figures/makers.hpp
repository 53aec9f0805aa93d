// Random shapes of every kind, of about the requested size.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "host/scene/shape.hpp"
#include "tests/support/random.hpp"

namespace eyeray::engine::test {

using MakeShape = std::unique_ptr<Shape> (*)(Random& random, double size);

// The makers by the names of their shapes.
const std::map<std::string, MakeShape>& shape_makers();

}  // namespace eyeray::engine::test
