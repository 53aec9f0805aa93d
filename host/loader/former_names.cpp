#include "host/loader/former_names.hpp"

#include <utility>

namespace eyeray::engine::loader {
namespace {

constexpr std::pair<std::string_view, std::string_view> former[] = {
    {"solid", "csg"},
    {"min_weight", "min_throughput"},
};

void rename_in(toml::node& node) {
  if (toml::array* list = node.as_array()) {
    for (toml::node& element : *list) rename_in(element);
  } else if (toml::table* table = node.as_table()) {
    rename_former(*table);
  }
}

// Moves the value of the former name to today's name. If both have lists, appends one to the other.
void rename(toml::table& table, toml::table::iterator it, std::string_view today) {
  toml::array* both = table[today].as_array();
  toml::array* more = it->second.as_array();
  if (both && more) {
    for (toml::node& element : *more) both->push_back(std::move(element));
  } else {
    table.insert(toml::key(today, toml::source_region(it->first.source())), std::move(it->second));
  }
}

}  // namespace

std::string_view name_today(std::string_view key) {
  for (const auto& [then, today] : former)
    if (key == then) return today;
  return key;
}

void rename_former(toml::table& root) {
  for (const auto& [then, today] : former) {
    const auto it = root.find(then);
    if (it == root.end()) continue;
    rename(root, it, today);
    root.erase(then);
  }
  for (auto&& [key, node] : root) rename_in(node);
}

}  // namespace eyeray::engine::loader
