// Scene → records: the float64 scene as the flat float32 buffers that the shaders read.
#pragma once

#include "records/packer.hpp"
#include "scene/scene.hpp"

namespace eyeray {

PackedScene pack(const Scene& scene);

}  // namespace eyeray
