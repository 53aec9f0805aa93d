// Interfaces: borders between media of the same index. They refract nothing, so shadow rays pass through
// them.
#pragma once

#include "host/scene/scene.hpp"

namespace eyeray::engine {

// True if paths of the scene may cross an interface. That is so if a medium has the index of the medium
// around all shapes, or if two media have the same index and at least one of them scatters. Two clear glasses
// that touch form no interface.
bool any_interface(const Scene& scene);

}  // namespace eyeray::engine
