// Records of CSG objects, whose leaves are separate records that stand with the vertices
// (shaders/shapes/csg.glsl).
#pragma once

#include "host/records/packer.hpp"

namespace eyeray::engine::pack {

// Fills in the leaves' loss of a shadow ray, takes note of their kinds and materials, and gives the
// CSG object the material of the densest.
void finish_csg(shader::Primitive& csg, records::PackedScene& packed);

}  // namespace eyeray::engine::pack
