#include "host/loader/formula_refusal.hpp"

#include <fmt/format.h>

#include "host/scene/value.hpp"

namespace eyeray::loader {

namespace {

void refuse(const toml::node& node, bool in_implicit, DiagnosticLog& log) {
  if (const toml::array* array = node.as_array())
    for (const toml::node& element : *array) refuse(element, in_implicit, log);
  const toml::table* table = node.as_table();
  if (!table) return;
  for (const auto& [key, value] : *table) {
    if (in_implicit && (key == "code" || key == "file"))
      log.error(position_of(value.source()),
                fmt::format("`{}` has a function, which --no-formulas refuses", key.str()));
    refuse(value, in_implicit || key == "implicit", log);
  }
}

}  // namespace

void refuse_formulas(const toml::table& root, DiagnosticLog& log) {
  refuse(root, false, log);
}

}  // namespace eyeray::loader
