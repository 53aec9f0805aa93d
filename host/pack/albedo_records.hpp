// The tables of albedos that a scene's lobes ask for.
#pragma once

#include "host/records/packer.hpp"

namespace eyeray::engine::pack {

// After the materials: of `packed.lobes`.
void pack_albedos(records::PackedScene& packed);

}  // namespace eyeray::engine::pack
