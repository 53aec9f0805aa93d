// [environment]: light from all around.
#pragma once

#include <memory>

#include "host/loader/sections.hpp"
#include "host/scene/environment.hpp"
#include "host/scene/table.hpp"

namespace eyeray::loader {

// A kind of environment: `type` in the table, and how it comes to be.
struct EnvironmentType {
  std::string_view name;
  std::string_view manual;
  std::span<const Key> keys;  // beside those that all have
  // Null after an error, which is reported to the table.
  std::shared_ptr<EnvironmentMap> (*parse)(TableReader& table, const ValueSources& sources,
                                           DiagnosticLog& log);
};

std::span<const EnvironmentType* const> environment_types();
std::span<const Key> environment_keys();

// Null where the table is not written, or after an error.
std::shared_ptr<const EnvironmentMap> read_environment(const Section& section, const toml::table* table,
                                                       const ValueSources& sources, DiagnosticLog& log);

}  // namespace eyeray::loader
