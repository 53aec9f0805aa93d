// The GLSL of a scene's formulas: colours for textures/formula.glsl, and surfaces for shapes/implicit.glsl,
// each surface with its own march.
#pragma once

#include <string>

#include "host/expression/loaded_numbers.hpp"
#include "host/records/packer.hpp"

namespace eyeray::engine::executors {

// The functions of all formulas. With `numbers`, they load their numbers (FORMULA_NUMBERS of
// kernels/features.h).
std::string formula_functions(const records::PackedScene& scene, expression::LoadedNumbers* numbers);

}  // namespace eyeray::engine::executors
