// Records of CSG objects, whose leaves are separate records that stand with the vertices
// (shaders/shapes/csg.glsl).
#pragma once

#include "host/records/packer.hpp"

namespace eyeray::engine::pack {

// Fills in how much the leaves weaken a shadow ray, takes note of the leaves' kinds and materials, and gives
// the CSG object the material of the densest leaf.
void finish_csg(shader::Primitive& csg, records::PackedScene& packed);

}  // namespace eyeray::engine::pack
