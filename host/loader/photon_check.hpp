// What `sppm` cannot do with a scene.
#pragma once

#include <span>

#include "host/scene/diagnostic_log.hpp"
#include "host/scene/scene.hpp"
#include "host/scene/table_reader.hpp"

namespace eyeray::loader {

// Makes a background that shines an environment, which photons can come from, and says what is wrong.
// `render`: the scene's own table; `lights`: where each of its lights stands.
void prepare_for_photons(Scene& scene, TableReader& render, std::span<const SourcePosition> lights,
                         DiagnosticLog& log);

}  // namespace eyeray::loader
