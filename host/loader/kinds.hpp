// Reads tables whose `type` selects one of several kinds. Each kind has its own keys.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "host/core/diagnostic_log.hpp"
#include "host/loader/sections.hpp"
#include "host/reading/source_position.hpp"
#include "host/reading/table.hpp"

namespace eyeray::engine::loader {

// The row of `types` that the table's `type` names, or the default of `type` if it is not written. Null if
// there is no such row.
template <typename Type>
const Type* named_type(const toml::table* table, const Section& section, std::span<const Type* const> types) {
  const toml::node* name = table ? table->get("type") : nullptr;
  const reading::Key& key = *std::ranges::find(section.keys, "type", &reading::Key::name);
  if (!name && !key.fallback.empty()) name = &fallback_of(key);
  if (!name || !name->is_string()) return nullptr;
  const auto found = std::ranges::find(types, name->as_string()->get(), &Type::name);
  return found == types.end() ? nullptr : *found;
}

// The names of the keys that `own` lacks and other kinds have, each once.
template <typename Type>
std::vector<std::string_view> keys_of_others(const Type& own, std::span<const Type* const> types) {
  std::vector<std::string_view> names;
  for (const Type* type : types)
    for (const reading::Key& key : type->keys)
      if (std::ranges::find(own.keys, key.name, &reading::Key::name) == own.keys.end() &&
          std::ranges::find(names, key.name) == names.end())
        names.push_back(key.name);
  return names;
}

// Adds an error at each of `keys` that is written: only other kinds have them.
template <typename Type>
void refuse_keys(const toml::table& table, std::span<const std::string_view> keys,
                 std::span<const Type* const> types, DiagnosticLog& log) {
  for (const std::string_view name : keys) {
    const toml::node* written = table.get(name);
    if (!written) continue;
    std::vector<std::string> owners;
    for (const Type* type : types)
      if (std::ranges::find(type->keys, name, &reading::Key::name) != type->keys.end())
        owners.push_back(fmt::format("\"{}\"", type->name));
    log.error(reading::position_of(written->source()),
              fmt::format("`{}` is for type = {} only", name, fmt::join(owners, " or ")));
  }
}

template <typename Type>
struct Kind {
  const Type* type;
  reading::TableReader reader;
};

// Reads the type of a table, and the table by the keys of that type. The type is null after an error in it,
// which is in the log. `table`: null if it is not written. `extra_keys`: keys that other code reads.
template <typename Type>
Kind<Type> read_kind(const Section& section, const toml::table* table, std::span<const Type* const> types,
                     const reading::ValueSources& sources, DiagnosticLog& log,
                     std::span<const std::string_view> extra_keys = {}) {
  const Type* type = named_type(table, section, types);
  const std::string title = type ? fmt::format("{} of type {}", section.title, type->name) : section.title;
  const std::vector<std::string_view> others =
      type ? keys_of_others(*type, types) : std::vector<std::string_view>();
  if (table) refuse_keys(*table, others, types, log);
  return {type,
          reading::read_table({.title = title,
                               .table = table,
                               .keys = {section.keys, type ? type->keys : std::span<const reading::Key>()},
                               .extra_keys = extra_keys,
                               .refused_keys = others,
                               .open = !type,
                               .sources = sources},
                              log)};
}

}  // namespace eyeray::engine::loader
