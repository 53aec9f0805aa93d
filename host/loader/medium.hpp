// [medium]: the medium around all shapes, and its extent.
#pragma once

#include "host/core/diagnostic_log.hpp"
#include "host/reading/table_reader.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::loader {

std::span<const reading::Key> medium_keys();
std::string_view medium_manual();

// These functions read the table, and report conflicts between its values to it. The medium is a vacuum for
// integrators that do not support media.
Medium read_medium(reading::TableReader& table, IntegratorType integrator);
MediumExtent read_medium_extent(reading::TableReader& table);

// Warns where the light of a sun, an environment or a background is lost in the medium because it has no end.
void warn_of_endless_medium(const Scene& scene, DiagnosticLog& log);

}  // namespace eyeray::engine::loader
