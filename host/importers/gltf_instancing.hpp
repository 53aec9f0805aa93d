// Reads the instances of a node's mesh (EXT_mesh_gpu_instancing). Private to the importers.
#pragma once

#include <vector>

#include "host/importers/gltf_breaches.hpp"
#include "host/importers/gltf_buffers.hpp"

namespace eyeray::engine::importers {

// The transforms of the instances in the space of the node that has the extension. InputError, with the
// position, unless all attributes have equally many elements and every rotation has a length.
std::vector<Mat4> instance_transforms(const GltfObject& extension, const GltfObject& document,
                                      GltfBuffers& buffers, GltfBreaches& breaches);

}  // namespace eyeray::engine::importers
