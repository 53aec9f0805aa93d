// The lights of a glTF file (KHR_lights_punctual). Private to the importers.
#pragma once

#include <vector>

#include "host/importers/gltf_breaches.hpp"
#include "host/importers/gltf_materials.hpp"
#include "host/importers/import.hpp"

namespace eyeray::engine::importers {

// Appends the light `source` of a node to the scene; `world` is the node's transform to the world.
// InputError, with the position, for values that no light has.
void add_gltf_light(const GltfObject& source, const Mat4& world, GltfLeftOut& left_out,
                    GltfBreaches& breaches, ImportedScene& scene);

}  // namespace eyeray::engine::importers
