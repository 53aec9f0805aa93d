// A small scene as constants in the text of its kernels, which then load less of the scene, or nothing.
#pragma once

#include <cstdint>
#include <set>
#include <string>

#include "host/records/packer.hpp"

namespace eyeray::engine::executors {

// True if the records are so few that making them constants saves more than the larger code costs.
bool few_shading_records(const records::PackedScene& scene);
bool few_primitives(const records::PackedScene& scene);

// Everything but geometry and texels as constants, and the list of materials that materials/material.glsl
// unrolls. A scene with images gets no such list: each material is then far more code than the choice between
// materials.
std::string shading_as_constants(const records::PackedScene& scene, const std::set<uint32_t>& materials_used);

// The values that are the same for all pixels, as a constant.
std::string frame_as_constant(const shader::Frame& frame);

// Geometry as constants, and the list of primitives that bvh/traverse.glsl unrolls, in the order of their
// ids.
std::string primitives_as_constants(const records::PackedScene& scene);

}  // namespace eyeray::engine::executors
