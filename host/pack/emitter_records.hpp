// Packs the lights that a path may choose from as records.
#pragma once

#include "host/records/packer.hpp"
#include "host/scene/light_choice.hpp"

namespace eyeray::engine::pack {

// Appends the scene's lights and surfaces as PackedScene::emitters.
void pack_light_choice(const LightChoice& choice, records::Packer& packer);

}  // namespace eyeray::engine::pack
