#include "host/reading/table_reader.hpp"

#include <fmt/ranges.h>
#include <algorithm>
#include <map>

#include "host/core/error.hpp"
#include "host/formula/formula.hpp"
#include "host/reading/foreign_words.hpp"
#include "host/reading/source_position.hpp"
#include "host/reading/table.hpp"

namespace eyeray::engine::reading {

struct TableReader::Table {
  struct Row {
    const Key* key;
    const toml::node* node;  // null: the key is not written
    Value value;             // has been checked; a stand-in after an error
    bool failed;
  };

  Table(const TableSource& from, DiagnosticLog& to) : source(from), log(to) {
    for (const std::span<const Key> keys : source.keys) {
      for (const Key& key : keys) rows.push_back(read(key));
    }
    check_names();
  }

  const Row& row(std::string_view name) const;
  template <typename T>
  const T& get(std::string_view name) const;

  SourcePosition position() const;
  void error(const SourcePosition& at, std::string message);

  TableSource source;
  DiagnosticLog& log;
  std::vector<Row> rows;
  bool failed = false;

 private:
  const toml::node* find(std::string_view name) const;
  SourcePosition header() const {
    return source.table ? position_of(source.table->source()) : SourcePosition{};
  }
  Row read(const Key& key);
  void check_names();
};

// Looks a key up in the batch, then in the table.
const toml::node* TableReader::Table::find(std::string_view name) const {
  if (source.batch) {
    const toml::node* list = source.batch->get(name);
    if (list) return list->as_array()->get(source.element);
  }
  return source.table ? source.table->get(name) : nullptr;
}

TableReader::Table::Row TableReader::Table::read(const Key& key) {
  const toml::node* node = find(key.name);
  if (!node && key.fallback.empty()) {
    const bool wrong = !key.optional && !log.damaged();
    if (wrong) error(header(), fmt::format("{} needs `{}`, {}", source.title, key.name, describe(key)));
    failed = failed || !key.optional;
    return {&key, nullptr, stand_in(key, source.sources), !key.optional};
  }
  if (node) {
    if (auto value = read_value(key, *node, log, source.sources))
      return {&key, node, std::move(*value), false};
    failed = true;
  }

  // Take the default if the value is absent or wrong.
  const bool wrong = node != nullptr;
  if (key.fallback.empty()) return {&key, node, stand_in(key, source.sources), wrong};
  auto value = read_value(key, fallback_of(key), log, source.sources);
  CHECK(value.has_value());
  return {&key, node, std::move(*value), wrong};
}

// Reports the table's keys that were not declared.
void TableReader::Table::check_names() {
  if (!source.table || source.open) return;
  std::vector<std::string_view> names;
  for (const Row& row : rows) names.push_back(row.key->name);
  names.insert(names.end(), source.extra_keys.begin(), source.extra_keys.end());
  for (const auto& [written, node] : *source.table) {
    if (std::ranges::find(names, written.str()) != names.end()) continue;
    if (std::ranges::find(source.refused_keys, written.str()) != source.refused_keys.end()) continue;
    if (log.full()) {
      error(position_of(written.source()), "unknown key");
      continue;
    }
    const std::string nearest = suggest_name(written.str(), names);
    const std::string hint = nearest.empty() ? fmt::format("; its keys are {}", fmt::join(names, ", "))
                                             : fmt::format("; did you mean `{}`?", nearest);
    error(position_of(written.source()),
          fmt::format("unknown key `{}` in {}{}", written.str(), source.title, hint));
  }
}

SourcePosition TableReader::Table::position() const {
  if (source.batch && !source.batch->empty())
    return position_of(find(source.batch->begin()->first)->source());
  return header();
}

void TableReader::Table::error(const SourcePosition& at, std::string message) {
  failed = true;
  log.error(at, std::move(message));
}

const TableReader::Table::Row& TableReader::Table::row(std::string_view name) const {
  const auto found = std::ranges::find(rows, name, [](const Row& row) { return row.key->name; });
  if (found == rows.end())
    detail::check_failed(__FILE__, __LINE__, "key is declared", fmt::format(" ({})", name));
  return *found;
}

template <typename T>
const T& TableReader::Table::get(std::string_view name) const {
  const T* value = std::get_if<T>(&row(name).value);
  if (!value) detail::check_failed(__FILE__, __LINE__, "key is read as its type", fmt::format(" ({})", name));
  return *value;
}

TableReader::TableReader(std::unique_ptr<Table> table) : table_(std::move(table)) {}
TableReader::~TableReader() = default;

bool TableReader::has(std::string_view key) const {
  return table_->row(key).node != nullptr;
}
bool TableReader::boolean(std::string_view key) const {
  return table_->get<bool>(key);
}
int64_t TableReader::integer(std::string_view key) const {
  return table_->get<int64_t>(key);
}
double TableReader::number(std::string_view key) const {
  return table_->get<double>(key);
}
bool TableReader::is_word(std::string_view key) const {
  return std::holds_alternative<std::string>(table_->row(key).value);
}
std::string TableReader::string(std::string_view key) const {
  return table_->get<std::string>(key);
}
int TableReader::choice(std::string_view key) const {
  return static_cast<int>(table_->get<int64_t>(key));
}
std::array<int, 2> TableReader::choice2(std::string_view key) const {
  const auto& both = table_->get<std::array<int64_t, 2>>(key);
  return {static_cast<int>(both[0]), static_cast<int>(both[1])};
}
Vec2 TableReader::vec2(std::string_view key) const {
  return table_->get<Vec2>(key);
}
Vec3 TableReader::vec3(std::string_view key) const {
  return table_->get<Vec3>(key);
}
std::vector<Vec2> TableReader::vec2_list(std::string_view key) const {
  return table_->get<std::vector<Vec2>>(key);
}
std::vector<Vec3> TableReader::vec3_list(std::string_view key) const {
  return table_->get<std::vector<Vec3>>(key);
}
std::vector<std::vector<Vec3>> TableReader::outlines(std::string_view key) const {
  return table_->get<std::vector<std::vector<Vec3>>>(key);
}
std::vector<std::vector<double>> TableReader::rows(std::string_view key) const {
  return table_->get<std::vector<std::vector<double>>>(key);
}
formula::FormulaText TableReader::formula(std::string_view key) const {
  return table_->get<formula::FormulaText>(key);
}
std::vector<formula::FormulaParameter> TableReader::parameters(std::string_view key) const {
  return table_->get<std::vector<formula::FormulaParameter>>(key);
}
std::vector<Vec4> TableReader::color_map(std::string_view key) const {
  return table_->get<std::vector<Vec4>>(key);
}
Vec3 TableReader::color(std::string_view key) const {
  return table_->get<Vec3>(key);
}
TexturePtr TableReader::texture(std::string_view key) const {
  return table_->get<TexturePtr>(key);
}
Vec2 TableReader::scale2(std::string_view key) const {
  return table_->get<Vec2>(key);
}
Vec3 TableReader::scale3(std::string_view key) const {
  return table_->get<Vec3>(key);
}
Mat4 TableReader::transform(std::string_view key) const {
  return table_->get<Mat4>(key);
}

std::shared_ptr<const ImageTexture> TableReader::load_image(std::string_view key, ImageTexture wanted) {
  if (!table_->source.sources.images) return error(key, "only a scene in a file can have images"), nullptr;
  auto image = table_->source.sources.images->load(std::move(wanted), position(key));
  table_->failed = table_->failed || !image;
  return image;
}

std::shared_ptr<const std::string> TableReader::load_font(std::string_view key) {
  if (!table_->source.sources.fonts) return error(key, "only a scene in a file can have fonts"), nullptr;
  auto font = table_->source.sources.fonts->load(string(key), position(key));
  table_->failed = table_->failed || !font;
  return font;
}

void TableReader::error(std::string_view key, std::string message, std::initializer_list<size_t> element) {
  const Table::Row& row = table_->row(key);
  if (row.failed) return;
  if (!row.node && table_->log.damaged()) {  // the key may stand in the unparsed text
    table_->failed = true;
    return;
  }
  const toml::node* at = row.node;
  for (const size_t i : element)
    if (at) at = at->as_array()->get(i);
  table_->error(at ? position_of(at->source()) : position(key), std::move(message));
}

void TableReader::warning(std::string_view key, std::string message) {
  table_->log.warning(position(key), std::move(message));
}

void TableReader::warning(const SourcePosition& position, std::string message) {
  table_->log.warning(position, std::move(message));
}

void TableReader::error(const InputError& faults) {
  for (const Diagnostic& fault : faults.diagnostics()) table_->error(fault.position, fault.message);
}

bool TableReader::valid(std::string_view key) const {
  return !table_->row(key).failed;
}
bool TableReader::failed() const {
  return table_->failed;
}
SourcePosition TableReader::position() const {
  return table_->position();
}

SourcePosition TableReader::position(std::string_view key) const {
  const toml::node* node = table_->row(key).node;
  return node ? position_of(node->source()) : position();
}

TableReader read_table(const TableSource& source, DiagnosticLog& log) {
  return TableReader(std::make_unique<TableReader::Table>(source, log));
}

const toml::node& fallback_of(const Key& key) {
  thread_local std::map<std::string_view, toml::table> parsed;
  auto [entry, fresh] = parsed.try_emplace(key.fallback);
  if (fresh) entry->second = toml::parse(fmt::format("value = {}", key.fallback));
  return *entry->second.get("value");
}

}  // namespace eyeray::engine::reading
