#pragma once

#include "host/records/packer.hpp"
#include "host/scene/environment.hpp"

namespace eyeray::engine::pack {

// How many texels pack_environment() writes.
size_t environment_texels(const EnvironmentMap& environment);
// As PackedScene::environment has it.
RawVector<shader::uvec4> pack_environment(const EnvironmentMap& environment);

}  // namespace eyeray::engine::pack
