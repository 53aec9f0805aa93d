// [environment]: light from all around.
#pragma once

#include <memory>

#include "host/loader/sections.hpp"
#include "host/reading/table.hpp"
#include "host/scene/environment.hpp"
#include "host/scene/light.hpp"

namespace eyeray::engine::loader {

// The environment of a scene, and the lights from it; either may be absent.
struct Surroundings {
  std::shared_ptr<EnvironmentMap> map;
  std::unique_ptr<Light> sun;
};

// A kind of environment: `type` in the table, and how it comes to be.
struct EnvironmentType {
  std::string_view name;
  std::string_view manual;
  std::span<const reading::Key> keys;  // beside those that all have
  // Nothing after an error, which is reported to the table.
  Surroundings (*parse)(reading::TableReader& table, const reading::ValueSources& sources,
                        DiagnosticLog& log);
};

std::span<const EnvironmentType* const> environment_types();
std::span<const reading::Key> environment_keys();

// Nothing where the table is not written, or after an error.
Surroundings read_environment(const Section& section, const toml::table* table,
                              const reading::ValueSources& sources, DiagnosticLog& log);

}  // namespace eyeray::engine::loader
