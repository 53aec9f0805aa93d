#include "host/loader/lights.hpp"

#include "host/loader/kinds.hpp"

namespace eyeray::loader {

// The type comes first, for it decides which other keys there are.
std::unique_ptr<Light> read_light(const Section& section, const toml::table& table, DiagnosticLog& log) {
  const LightType* type = named_type(table, light_types());
  const std::string title = type ? fmt::format("[[light]] of type {}", type->name) : section.title;
  const std::vector<std::string_view> others =
      type ? keys_of_others(*type, light_types()) : std::vector<std::string_view>();
  TableReader reader = read_table({.title = title,
                                   .table = &table,
                                   .keys = {section.keys, type ? type->keys : std::span<const Key>()},
                                   .extra_keys = others,
                                   .open = !type},
                                  log);
  if (!type) return nullptr;
  refuse_keys_of_others(table, *type, light_types(), log);
  return type->parse(reader);
}

}  // namespace eyeray::loader
