// Checks for scenes that `sppm` cannot render.
#pragma once

#include <span>

#include "host/core/diagnostic_log.hpp"
#include "host/reading/table_reader.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

// Makes a background that shines an environment, which photons can come from, and reports faults. `render`:
// the scene's own table; `lights`: where each of its lights stands.
void prepare_for_photons(Scene& scene, reading::TableReader& render, std::span<const SourcePosition> lights,
                         DiagnosticLog& log);

}  // namespace eyeray::engine::loader
