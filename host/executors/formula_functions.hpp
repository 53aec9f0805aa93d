// The GLSL of a scene's formulas: colours for textures/formula.glsl, and for shapes/implicit.glsl surfaces,
// each with a march of its own.
#pragma once

#include <string>

#include "host/records/packer.hpp"

namespace eyeray::executors {

std::string formula_functions(const records::PackedScene& scene);

}  // namespace eyeray::executors
