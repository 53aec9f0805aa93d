#include "host/compute/document.hpp"

#include <fmt/ranges.h>

#include <algorithm>

#include "host/core/input_file.hpp"
#include "host/reading/source_position.hpp"
#include "host/reading/table.hpp"
#include "host/reading/toml_text.hpp"

namespace fs = std::filesystem;

namespace eyeray::engine::compute {
namespace {

constexpr size_t most_document_bytes = size_t{64} << 20;

// The parsed override; nothing if it is no TOML.
std::optional<toml::table> parse(const std::string& text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error&) {
    return std::nullopt;
  }
}

// Moves the only leaf of `over` into `below`; false if `over` has none or several.
bool merge(toml::table& below, toml::table& over) {
  if (over.size() != 1) return false;
  auto entry = over.begin();
  toml::table* const inner = entry->second.as_table();
  if (!inner || inner->is_inline()) {
    const toml::key key = entry->first;
    toml::node& value = entry->second;
    below.erase(key.str());
    below.insert_or_assign(key, std::move(value));
    return true;
  }
  toml::node* at = below.get(entry->first.str());
  if (!at || !at->is_table()) at = &below.insert_or_assign(entry->first, toml::table()).first->second;
  return merge(*at->as_table(), *inner);
}

}  // namespace

Document read_document(const fs::path& file, DiagnosticLog& log) {
  Document document{file, {}};
  std::string text = read_input_file(file, "the kernel file", most_document_bytes);
  drop_byte_order_mark(text);
  reading::TreeBudget budget;
  document.root =
      reading::parse_toml(log.add_source(file.string(), std::move(text)), file.string(), budget, log);
  return document;
}

void apply_overrides(Document& document, const std::vector<std::string>& overrides, DiagnosticLog& log) {
  for (const std::string& text : overrides) {
    const std::string written = "-D " + text;
    const size_t equals = text.find('=');
    reading::TreeBudget budget;
    std::optional<toml::table> tree;
    if (text.find('\n') == std::string::npos && !reading::find_excess(text, budget)) {
      tree = parse(text, written);
      // A word needs no quotes.
      if (!tree && equals != std::string::npos && text.find_first_of("\"\\", equals) == std::string::npos)
        tree = parse(fmt::format("{}=\"{}\"", text.substr(0, equals), text.substr(equals + 1)), written);
    }
    if (!tree || !merge(document.root, *tree))
      log.error({printable(written), 0, 0}, "write KEY=VALUE, such as push.scale=2 or buffer.NAME.fill=0");
  }
}

fs::path path_at(const Document& document, const toml::node& node) {
  const fs::path path = node.value_or(std::string());
  const bool of_file = reading::position_of(node.source()).file == document.file.string();
  return of_file ? document.file.parent_path() / path : path;
}

reading::TableReader read_keys(Table table, std::string_view title, const toml::table& from,
                               DiagnosticLog& log) {
  const KernelTable& declared = kernel_table(table);
  reading::TableSource source{.title = title, .table = &from};
  source.keys[1] = declared.keys;
  source.extra_keys = declared.lists;
  return reading::read_table(source, log);
}

const toml::table* table_at(const toml::table& from, std::string_view key, DiagnosticLog& log) {
  const toml::node* const node = from.get(key);
  if (!node) return nullptr;
  if (!node->is_table())
    log.error(reading::position_of(node->source()), fmt::format("`{}` must be a table", key));
  return node->as_table();
}

std::vector<const toml::node*> strings_at(const toml::table& from, std::string_view key, DiagnosticLog& log) {
  const toml::node* const node = from.get(key);
  if (!node) return {};
  std::vector<const toml::node*> strings;
  const toml::array* const list = node->as_array();
  if (list)
    for (const toml::node& each : *list)
      if (each.is_string()) strings.push_back(&each);
  if (!list || strings.size() < list->size()) {
    log.error(reading::position_of(node->source()), fmt::format("`{}` must be a list of strings", key));
    return {};
  }
  return strings;
}

std::optional<std::array<uint32_t, 3>> sizes_at(const toml::table& from, std::string_view key,
                                                DiagnosticLog& log) {
  const toml::node* const node = from.get(key);
  if (!node) return std::nullopt;
  std::array<uint32_t, 3> sizes{1, 1, 1};
  const toml::array* const list = node->as_array();
  bool right = list ? !list->empty() && list->size() <= 3 : true;
  for (size_t axis = 0; right && axis < (list ? list->size() : 1); ++axis) {
    const toml::node& each = list ? *list->get(axis) : *node;
    const auto value = each.is_integer() ? each.value<int64_t>() : std::nullopt;
    right = value && *value >= 1 && *value <= UINT32_MAX;
    if (right) sizes[axis] = uint32_t(*value);
  }
  if (right) return sizes;
  log.error(reading::position_of(node->source()),
            fmt::format("`{}` must be one to three whole numbers from 1 to 4294967295, such as [8, 8]", key));
  return std::nullopt;
}

std::string suggest(std::string_view name, const std::vector<std::string>& names) {
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string nearest = nearest_name(name, views);
  if (!nearest.empty()) return fmt::format("; did you mean `{}`?", nearest);
  return names.empty() ? "" : fmt::format("; there are {}", fmt::join(names, ", "));
}

}  // namespace eyeray::engine::compute
