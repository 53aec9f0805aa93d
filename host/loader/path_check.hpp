// Checks for features of Whitted's pictures that paths cannot show, or not with the given numbers.
#pragma once

#include "host/core/diagnostic_log.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

// Warns of materials that scatter more light than they get, and of light that no path finds. The scene must
// be sound and have shapes, and an integrator that walks at random.
void warn_of_paths(const Scene& scene, DiagnosticLog& log);

}  // namespace eyeray::engine::loader
