// Shapes of every kind at random, about as large as asked for.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "host/scene/shape.hpp"
#include "tests/support/random.hpp"

namespace eyeray::engine::test {

using MakeShape = std::unique_ptr<Shape> (*)(Random& random, double size);

// By the shapes' names.
const std::map<std::string, MakeShape>& shape_makers();

}  // namespace eyeray::engine::test
