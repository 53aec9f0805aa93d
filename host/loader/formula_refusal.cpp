#include "host/loader/formula_refusal.hpp"
#include "host/core/option_text.hpp"

#include <fmt/format.h>

#include "host/reading/source_position.hpp"

namespace eyeray::engine::loader {

namespace {

// Adds the errors in a node. `may_have`: true if tables in the node may have a function.
void refuse(const toml::node& node, bool may_have, DiagnosticLog& log) {
  if (const toml::array* array = node.as_array())
    for (const toml::node& element : *array) refuse(element, may_have, log);
  const toml::table* table = node.as_table();
  if (!table) return;
  for (const auto& [key, value] : *table) {
    if (may_have && (key == "code" || key == "file"))
      log.error(reading::position_of(value.source()),
                fmt::format("`{}` has a function, which {} refuses", key.str(), option_text("no-formulas")));
    refuse(value, may_have || key == "implicit" || key == "formula", log);
  }
}

}  // namespace

void refuse_formulas(const toml::table& root, DiagnosticLog& log) {
  refuse(root, false, log);
}

}  // namespace eyeray::engine::loader
