// Reads [environment]: light from all directions.
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

// A kind of environment: its name, which is `type` in the table, its keys and its reader.
struct EnvironmentType {
  std::string_view name;
  std::string_view manual;
  std::span<const reading::Key> keys;  // beside the keys of all kinds
  // Makes the environment; nothing after an error, which is reported to the table.
  Surroundings (*parse)(reading::TableReader& table, const reading::ValueSources& sources,
                        DiagnosticLog& log);
};

std::span<const EnvironmentType* const> environment_types();
std::span<const reading::Key> environment_keys();

// The environment of a scene; nothing if the table is not written, or after an error.
Surroundings read_environment(const Section& section, const toml::table* table,
                              const reading::ValueSources& sources, DiagnosticLog& log);

}  // namespace eyeray::engine::loader
