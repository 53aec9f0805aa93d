#include "host/loader/batch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "host/reading/foreign_words.hpp"
#include "host/reading/source_position.hpp"
#include "host/reading/table.hpp"

namespace eyeray::engine::loader {

Batch read_batch(const Section& section, const toml::table& table, DiagnosticLog& log) {
  const toml::node* node = table.get(batch_key);
  if (!node) return {};
  const toml::table* lists = node->as_table();
  if (!lists || lists->empty()) {
    log.error(reading::position_of(node->source()),
              "`batch` must be a table of lists, such as { KEY = [value, …] }");
    return {nullptr, 0};
  }
  std::vector<std::string_view> names;
  for (const std::span<const reading::Key> keys :
       {section.keys, section.shape ? section.shape->keys : std::span<const reading::Key>()}) {
    for (const reading::Key& key : keys) names.push_back(key.name);
  }
  Batch batch{lists, 0};
  bool ok = true;
  const auto fail = [&](const toml::source_region& at, std::string message) {
    log.error(reading::position_of(at), std::move(message));
    ok = false;
  };
  const toml::key* first = nullptr;
  for (const auto& [key, list] : *lists) {
    if (std::ranges::find(names, key.str()) == names.end()) {
      const std::string nearest = reading::suggest_name(key.str(), names);
      fail(key.source(), fmt::format("unknown key `{}` in the batch of {}{}", key.str(), section.title,
                                     nearest.empty() ? "" : fmt::format("; did you mean `{}`?", nearest)));
    } else if (table.contains(key.str())) {
      fail(key.source(), fmt::format("`{}` is given both in the table and in its batch", key.str()));
    } else if (!list.is_array()) {
      fail(list.source(),
           fmt::format("`{}` in a batch must be a list of values, one for each object", key.str()));
    } else if (!first) {
      first = &key;
      batch.count = list.as_array()->size();
    } else if (list.as_array()->size() != batch.count) {
      fail(list.source(),
           fmt::format("`{}` has {} values, but `{}` has {}: the lists of a batch must be equally long",
                       key.str(), list.as_array()->size(), first->str(), batch.count));
    }
  }
  return ok ? batch : Batch{nullptr, 0};
}

std::string_view written_name(const toml::table& table, const Batch& batch, size_t element) {
  const toml::node* node = table.get("name");
  if (const toml::node* list = batch.lists ? batch.lists->get("name") : nullptr)
    node = list->as_array()->get(element);
  return node && node->is_string() ? std::string_view(node->as_string()->get()) : std::string_view();
}

}  // namespace eyeray::engine::loader
