// Records of solids, whose leaves are records of their own that stand with the vertices
// (shaders/shapes/solid.glsl).
#pragma once

#include "records/packer.hpp"

namespace eyeray {

// Fills in what the leaves weaken a shadow ray by, takes note of their kinds and materials, and gives the
// solid the material of the densest.
void finish_solid(shader::Primitive& solid, PackedScene& packed);

}  // namespace eyeray
