// Scene → records: the float64 scene as the flat float32 buffers that the shaders read.
#pragma once

#include "host/pack/options.hpp"
#include "host/records/packer.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::pack {

// Hits do not depend on the options. Error (bad_input), with the numbers, if the scene has more than records
// can count.
records::PackedScene pack(const Scene& scene, const PackOptions& options = {});
// Packs a scene without the images' texels, for code that counts and does not render.
records::PackedScene pack_without_texels(const Scene& scene);

}  // namespace eyeray::engine::pack
