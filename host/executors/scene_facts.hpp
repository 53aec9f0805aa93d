// What of a packed scene decides which code its kernels need.
#pragma once

#include <set>

#include "host/records/packer.hpp"

namespace eyeray::executors {

// Whether any texture of the material varies over a surface.
bool varies(const records::PackedScene& scene, const shader::Material& material);
bool any_emits(const records::PackedScene& scene);
bool any_absorbs(const records::PackedScene& scene);
// How often a path may go on: 0 where no material sends rays on, or the integrator none.
uint32_t most_bounces(const records::PackedScene& scene);
bool casts_shadow_rays(const records::PackedScene& scene);  // the scene's integrator

}  // namespace eyeray::executors
