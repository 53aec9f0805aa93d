#pragma once

#include "host/records/packer.hpp"
#include "host/scene/environment.hpp"

namespace eyeray::engine::pack {

// The number of texels that pack_environment() writes.
size_t environment_texels(const EnvironmentMap& environment);
// The environment in the form of PackedScene::environment.
RawVector<shader::uvec4> pack_environment(const EnvironmentMap& environment);

}  // namespace eyeray::engine::pack
