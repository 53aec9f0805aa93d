#include "host/loader/formula_refusal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

#include "host/core/option_text.hpp"
#include "host/reading/source_position.hpp"

namespace eyeray::engine::loader {

namespace {

// The tables whose `file` is a file of functions. `code` is a function in any table.
constexpr std::string_view tables_with_functions[] = {"camera", "formula", "implicit"};

// Adds the errors in a node. `may_have`: true if tables in the node may have a file of functions.
void refuse(const toml::node& node, bool may_have, DiagnosticLog& log) {
  if (const toml::array* array = node.as_array())
    for (const toml::node& element : *array) refuse(element, may_have, log);
  const toml::table* table = node.as_table();
  if (!table) return;
  for (const auto& [key, value] : *table) {
    if (key == "code" || (may_have && key == "file"))
      log.error(reading::position_of(value.source()),
                fmt::format("`{}` has a function, which {} refuses", key.str(), option_text("no-formulas")));
    refuse(value,
           may_have || std::ranges::find(tables_with_functions, key.str()) != std::end(tables_with_functions),
           log);
  }
}

}  // namespace

void refuse_formulas(const toml::table& root, DiagnosticLog& log) {
  refuse(root, false, log);
  if (log.has_errors()) throw InputError(log.sorted());
}

}  // namespace eyeray::engine::loader
