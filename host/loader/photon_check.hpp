// Checks for scenes that `sppm` cannot render.
#pragma once

#include <span>

#include "host/core/diagnostic_log.hpp"
#include "host/reading/table_reader.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

// Turns a background that emits light into an environment, from which photons can come, and reports faults.
// `render`: the scene's [render] table. `lights`: the position of each of its lights in the files.
void prepare_for_photons(Scene& scene, reading::TableReader& render, std::span<const SourcePosition> lights,
                         DiagnosticLog& log);

}  // namespace eyeray::engine::loader
