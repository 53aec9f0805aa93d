// Lists of tables in a scene file. Private to the loader.
#pragma once

#include <fmt/format.h>
#include <toml++/toml.h>

#include <string_view>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/sections.hpp"
#include "host/reading/source_position.hpp"

namespace eyeray::engine::loader {

// Calls visit(section, table) for the tables in the list `name` of `holder`. Returns false, and adds an
// error, if its value is no list or an element is no table. `holder_name`: for messages.
template <typename Visit>
bool for_each_table(const toml::table& holder, std::string_view name, DiagnosticLog& log, const Visit& visit,
                    std::string_view holder_name = "group") {
  const toml::node* list = holder.get(name);
  if (!list) return true;
  const Section& section = *find_section(name);
  if (!list->is_array()) {
    log.error(reading::position_of(list->source()),
              fmt::format("`{0}` must be a list of tables, written [[{1}.{0}]]", name, holder_name));
    return false;
  }
  bool ok = true;
  for (const toml::node& node : *list->as_array()) {
    if (node.is_table()) {
      visit(section, *node.as_table());
    } else {
      log.error(reading::position_of(node.source()), fmt::format("every {} must be a table", section.title));
      ok = false;
    }
  }
  return ok;
}

}  // namespace eyeray::engine::loader
