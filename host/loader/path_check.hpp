// What Whitted's pictures show and paths cannot, or not by the numbers that are given.
#pragma once

#include "host/core/diagnostic_log.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

// Of a sound scene with shapes, whose integrator walks at random.
void warn_of_paths(const Scene& scene, DiagnosticLog& log);

}  // namespace eyeray::engine::loader
