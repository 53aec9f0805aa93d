// Reads a [[light]] of a scene file.
#pragma once

#include <memory>

#include "host/loader/sections.hpp"
#include "host/reading/table.hpp"
#include "host/scene/light.hpp"

namespace eyeray::engine::loader {

// The light; null after an error, which is in the log.
std::unique_ptr<Light> read_light(const Section& section, const toml::table& table,
                                  const reading::ValueSources& sources, DiagnosticLog& log);

}  // namespace eyeray::engine::loader
