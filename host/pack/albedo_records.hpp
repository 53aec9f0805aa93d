// The tables of albedos that a scene's lobes need.
#pragma once

#include "host/records/packer.hpp"

namespace eyeray::engine::pack {

// Packs the tables for `packed.lobes`. Materials must be packed before.
void pack_albedos(records::PackedScene& packed);

}  // namespace eyeray::engine::pack
