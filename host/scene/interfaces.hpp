// Interfaces: borders between media of one index, which refract nothing, so that shadow rays pass them.
#pragma once

#include "host/scene/scene.hpp"

namespace eyeray::engine {

// True if paths of the scene may cross an interface: where a medium has the index of its surroundings, or of
// another medium and one of both scatters. Two clear glasses that touch are left alone.
bool any_interface(const Scene& scene);

}  // namespace eyeray::engine
