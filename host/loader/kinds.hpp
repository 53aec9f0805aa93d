// Tables whose `type` says which of several kinds they are: each kind has keys of its own.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "host/scene/diagnostic_log.hpp"
#include "host/scene/table.hpp"

namespace eyeray::loader {

// The row of `types` that the table's `type` names; null where it names none.
template <typename Type>
const Type* named_type(const toml::table& table, std::span<const Type* const> types) {
  const toml::node* written = table.get("type");
  if (!written || !written->is_string()) return nullptr;
  const auto found = std::ranges::find(types, written->as_string()->get(), &Type::name);
  return found == types.end() ? nullptr : *found;
}

// The names of the keys that other kinds than `own` have and it has not.
template <typename Type>
std::vector<std::string_view> keys_of_others(const Type& own, std::span<const Type* const> types) {
  std::vector<std::string_view> names;
  for (const Type* type : types)
    for (const Key& key : type->keys)
      if (std::ranges::find(own.keys, key.name, &Key::name) == own.keys.end()) names.push_back(key.name);
  return names;
}

// Reports each key that is written and only other kinds than `own` have.
template <typename Type>
void refuse_keys_of_others(const toml::table& table, const Type& own, std::span<const Type* const> types,
                           DiagnosticLog& log) {
  for (const std::string_view name : keys_of_others(own, types)) {
    const toml::node* written = table.get(name);
    const auto owner = std::ranges::find_if(types, [&](const Type* type) {
      return std::ranges::find(type->keys, name, &Key::name) != type->keys.end();
    });
    if (written)
      log.error(position_of(written->source()),
                fmt::format("`{}` is for type = \"{}\" only", name, (*owner)->name));
  }
}

}  // namespace eyeray::loader
