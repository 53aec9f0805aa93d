// The GLSL of a scene's formulas, each with its own march: what shapes/implicit.glsl finds surfaces by.
#pragma once

#include <string>

#include "host/records/packer.hpp"

namespace eyeray::executors {

std::string formula_functions(const records::PackedScene& scene);

}  // namespace eyeray::executors
