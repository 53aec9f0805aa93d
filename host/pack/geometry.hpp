// The primitives of a scene and the BVHs over them, as records.
#pragma once

#include "host/pack/pack.hpp"

namespace eyeray::engine::pack {

// Fills in everything of packer.scene that traversal reads. Materials are packed already. A mesh with one
// instance, or of one triangle, becomes primitives of the world; any other keeps its own object space and
// BVH.
void pack_geometry(const Scene& scene, const PackOptions& options, records::Packer& packer);

}  // namespace eyeray::engine::pack
