// Cameras of glTF. Private to the importers.
#pragma once

#include "host/importers/gltf_breaches.hpp"
#include "host/importers/import.hpp"

namespace eyeray::engine::importers {

// The camera at a node whose transform in the world is `world`: it looks along −z, and y is up. InputError
// for a camera of neither type or of both, and for one whose view has no size.
ImportedCamera gltf_camera(const GltfObject& source, const Mat4& world, GltfBreaches& breaches);

}  // namespace eyeray::engine::importers
