// Reads the [camera] of a scene file.
#pragma once

#include "host/loader/sections.hpp"
#include "host/reading/table.hpp"
#include "host/scene/camera.hpp"

namespace eyeray::engine::loader {

// The camera. `table`: null if it is not written. Errors are in the log; after an error the camera may have
// no projection.
Camera read_camera(const Section& section, const toml::table* table, const reading::ValueSources& sources,
                   DiagnosticLog& log);

}  // namespace eyeray::engine::loader
