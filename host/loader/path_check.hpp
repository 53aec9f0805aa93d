// Checks for features of Whitted's pictures that paths cannot show, or cannot show with the given numbers.
#pragma once

#include "host/core/diagnostic_log.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

// Warns of materials that scatter more light than they receive, and of lights that no path finds. The scene
// must be valid, have shapes, and have an integrator that walks at random.
void warn_of_paths(const Scene& scene, DiagnosticLog& log);

}  // namespace eyeray::engine::loader
