#include "host/loader/lights.hpp"

#include "host/lights/registry.hpp"
#include "host/loader/kinds.hpp"

namespace eyeray::engine::loader {

std::unique_ptr<Light> read_light(const Section& section, const toml::table& table,
                                  const reading::ValueSources& sources, DiagnosticLog& log) {
  constexpr std::string_view read_elsewhere[] = {repeat_key};
  auto [type, reader] = read_kind(section, &table, lights::types(), sources, log, read_elsewhere);
  return type ? type->parse(reader) : nullptr;
}

}  // namespace eyeray::engine::loader
