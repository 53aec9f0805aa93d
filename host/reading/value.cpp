#include "host/reading/value.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host/core/error.hpp"
#include "host/reading/expression_node.hpp"
#include "host/reading/foreign_words.hpp"
#include "host/reading/source_position.hpp"
#include "host/reading/table.hpp"
#include "host/reading/transform.hpp"
#include "host/scene/affine.hpp"

namespace eyeray::engine::reading {

namespace {

std::string describe_node(const toml::node& node) {
  if (const auto* text = node.as_string()) {
    constexpr size_t longest = 40;
    const std::string& whole = text->get();
    return fmt::format("\"{}\"{}", whole.substr(0, longest), whole.size() > longest ? "…" : "");
  }
  if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
  if (const auto* boolean = node.as_boolean()) return boolean->get() ? "true" : "false";
  if (const auto* array = node.as_array()) return fmt::format("a list of {}", array->size());
  return node.is_table() ? "a table" : "a date or time";
}

// Reads one value, and records whether all of it was right.
class Reader {
 public:
  Reader(const Key& key, DiagnosticLog& log, const ValueSources& sources)
      : key_(key), log_(log), sources_(sources) {}

  bool ok() const { return ok_; }
  Value value(const toml::node& node);

 private:
  void fail(const toml::node& node, std::string message) {
    ok_ = false;
    log_.error(position_of(node.source()), std::move(message));
  }
  void mismatch(const toml::node& node) {
    fail(node, fmt::format("`{}` must be {}, not {}", key_.name, describe(key_), describe_node(node)));
  }
  void mismatch(const toml::node& node, std::span<const double> values) {
    if (expression_of(node).empty()) return mismatch(node);
    fail(node,
         fmt::format(
             "`{}` must be {}, not {}, which is {}", key_.name, describe(key_), describe_node(node),
             values.size() == 1 ? fmt::format("{}", values[0]) : fmt::format("a list of {}", values.size())));
  }

  // The numbers that a number or an expression stands for; none, with an error, if it is neither.
  std::vector<double> numbers(const toml::node& node);
  double checked(double value, const toml::node& node);
  double number(const toml::node& node);
  int64_t integer(const toml::node& node);
  int64_t choice(const toml::node& node);
  std::array<int64_t, 2> choice2(const toml::node& node);
  TexturePtr texture(const toml::node& node);
  TexturePtr texture(const TextureType& type, const toml::table& table);
  Mat4 matrix(const toml::node& node);
  template <int N>
  glm::vec<N, double> vector(const toml::node& node, bool or_one_number = false);
  template <int N>
  std::vector<glm::vec<N, double>> vector_list(const toml::node& node);
  std::vector<std::vector<Vec3>> vector_lists(const toml::node& node);
  std::vector<std::vector<double>> rows(const toml::node& node);
  std::vector<Vec4> color_map(const toml::node& node);
  formula::FormulaText formula_file(const toml::node& node);
  std::vector<formula::FormulaParameter> parameters(const toml::node& node);

  const Key& key_;
  DiagnosticLog& log_;
  const ValueSources& sources_;
  bool ok_ = true;
};

std::vector<double> Reader::numbers(const toml::node& node) {
  if (node.is_number()) return {*node.value<double>()};
  if (!sources_.variables || expression_of(node).empty()) return mismatch(node), std::vector<double>{};
  auto values = evaluate(node, *sources_.variables, log_);
  ok_ = ok_ && values;
  return values.value_or(std::vector<double>{});
}

double Reader::number(const toml::node& node) {
  const std::vector<double> values = numbers(node);
  if (values.size() > 1) mismatch(node, values);
  return values.size() == 1 ? checked(values[0], node) : 0.0;
}

// The value; with an error if it is not in the key's range.
double Reader::checked(double value, const toml::node& node) {
  if (!std::isfinite(value)) {
    fail(node,
         fmt::format("`{}` must be finite, not {}", key_.name, std::isnan(value) ? std::nan("") : value));
  } else if (value < key_.min || value > key_.max || (key_.above_min && value <= key_.min) ||
             (key_.below_max && value >= key_.max)) {
    mismatch(node, {{value}});
  } else if (std::fabs(value) > largest_number) {
    fail(node, fmt::format("`{}` is {:g}, beyond the range of float32 arithmetic (±{:g})", key_.name, value,
                           largest_number));
  } else if (key_.above_min && key_.min >= 0 && value < 1 / largest_number) {
    fail(node, fmt::format("`{}` is {:g}, too small for float32 arithmetic (at least {:g})", key_.name, value,
                           1 / largest_number));
  }
  return value;
}

int64_t Reader::integer(const toml::node& node) {
  if (!expression_of(node).empty()) {
    const double value = number(node);
    if (ok_ && (std::trunc(value) != value || std::fabs(value) > 0x1p53)) mismatch(node, {{value}});
    return ok_ ? int64_t(value) : 0;
  }
  if (const auto* number = node.as_floating_point(); number && std::trunc(number->get()) == number->get()) {
    fail(node, fmt::format("`{0}` must be {1}; write {2:.0f} without a decimal point", key_.name,
                           describe(key_), number->get()));
    return 0;
  }
  if (!node.is_integer()) return mismatch(node), 0;
  const int64_t value = node.as_integer()->get();
  const auto real = static_cast<double>(value);
  if (real < key_.min || real > key_.max || (key_.above_min && real <= key_.min)) mismatch(node);
  return value;
}

int64_t Reader::choice(const toml::node& node) {
  if (const auto* text = node.as_string()) {
    const auto found = std::ranges::find(key_.choices, std::string_view(text->get()));
    if (found != key_.choices.end()) return found - key_.choices.begin();
    if (const std::string_view advice = advice_on(text->get(), key_.choices); !advice.empty()) {
      fail(node, fmt::format("`{}` must be {}, not {}; {}", key_.name, describe(key_), describe_node(node),
                             advice));
      return 0;
    }
    if (const std::string nearest = suggest_name(text->get(), key_.choices); !nearest.empty()) {
      fail(node, fmt::format("`{}` must be {}, not {}; did you mean \"{}\"?", key_.name, describe(key_),
                             describe_node(node), nearest));
      return 0;
    }
  }
  fail(node,
       fmt::format("`{}` must be {}, not {}{}", key_.name, describe(key_), describe_node(node), key_.hint));
  return 0;
}

std::array<int64_t, 2> Reader::choice2(const toml::node& node) {
  const toml::array* list = node.as_array();
  if (list && list->size() != 2) return mismatch(node), std::array<int64_t, 2>{};
  if (list) return {choice((*list)[0]), choice((*list)[1])};
  const int64_t both = choice(node);
  return {both, both};
}

template <int N>
glm::vec<N, double> Reader::vector(const toml::node& node, bool or_one_number) {
  glm::vec<N, double> value(0.0);
  if (node.is_number() && !or_one_number) return mismatch(node), value;
  if (node.is_number() || !expression_of(node).empty()) {
    const std::vector<double> values = numbers(node);
    if (values.size() == 1 && or_one_number) return glm::vec<N, double>(checked(values[0], node));
    if (values.size() != N && !values.empty()) mismatch(node, values);
    for (size_t i = 0; values.size() == N && i < N; ++i) value[int(i)] = checked(values[i], node);
    return value;
  }
  const toml::array* list = node.as_array();
  if (!list || list->size() != N) return mismatch(node), value;
  for (int i = 0; i < N; ++i) value[i] = number((*list)[static_cast<size_t>(i)]);
  return value;
}

template <int N>
std::vector<glm::vec<N, double>> Reader::vector_list(const toml::node& node) {
  std::vector<glm::vec<N, double>> values;
  const toml::array* list = node.as_array();
  if (!list) return mismatch(node), values;
  values.reserve(list->size());
  for (const toml::node& element : *list) values.push_back(vector<N>(element));
  return values;
}

std::vector<std::vector<Vec3>> Reader::vector_lists(const toml::node& node) {
  std::vector<std::vector<Vec3>> values;
  const toml::array* list = node.as_array();
  if (!list) return mismatch(node), values;
  for (const toml::node& element : *list) {
    const toml::array* points = element.as_array();
    if (!points || !std::ranges::all_of(*points, &toml::node::is_array)) return mismatch(element), values;
    values.push_back(vector_list<3>(element));
  }
  return values;
}

std::vector<std::vector<double>> Reader::rows(const toml::node& node) {
  std::vector<std::vector<double>> all;
  const toml::array* list = node.as_array();
  if (!list) return mismatch(node), all;
  for (const toml::node& element : *list) {
    const toml::array* row = element.as_array();
    if (!row || row->size() != key_.choices.size()) return mismatch(element), all;
    for (std::vector<double>& values = all.emplace_back(); const toml::node& value : *row)
      values.push_back(number(value));
  }
  return all;
}

std::vector<Vec4> Reader::color_map(const toml::node& node) {
  std::vector<Vec4> colors;
  const toml::array* list = node.as_array();
  if (!list || list->empty()) return mismatch(node), colors;
  for (const toml::node& element : *list) {
    const toml::array* pair = element.as_array();
    if (!pair || pair->size() != 2) return mismatch(element), colors;
    const bool calculated = !expression_of((*pair)[0]).empty();
    const double at = calculated ? number((*pair)[0]) : (*pair)[0].value<double>().value_or(-1);
    if (!ok_) return colors;
    if (!(at >= (colors.empty() ? 0 : colors.back().w) && at <= 1))
      return fail((*pair)[0], fmt::format("the position of a color in `{}` must be a number from 0 to 1, not "
                                          "less than the one before it",
                                          key_.name)),
             colors;
    colors.emplace_back(vector<3>((*pair)[1], true), at);
  }
  return colors;
}

formula::FormulaText Reader::formula_file(const toml::node& node) {
  if (!node.is_string()) return mismatch(node), formula::FormulaText{};
  if (!sources_.formulas)
    return fail(node, "only a scene in a file can name files of formulas"), formula::FormulaText{};
  auto text = sources_.formulas->load(node.value_or(std::string()), position_of(node.source()));
  ok_ = text.has_value();
  return text.value_or(formula::FormulaText{});
}

std::vector<formula::FormulaParameter> Reader::parameters(const toml::node& node) {
  std::vector<formula::FormulaParameter> all;
  const toml::table* table = node.as_table();
  if (!table) return mismatch(node), all;
  for (const auto& [key, value] : *table) {
    formula::FormulaParameter parameter{std::string(key.str()), {}};
    if (!formula::is_formula_name(parameter.name)) {
      ok_ = false;
      log_.error(position_of(key.source()),
                 fmt::format("\"{}\" cannot be the name of a constant in GLSL", parameter.name));
    }
    const toml::array* list = value.as_array();
    if (value.is_number())
      parameter.values = {number(value)};
    else if (!expression_of(value).empty())
      for (const double each : numbers(value)) parameter.values.push_back(checked(each, value));
    else if (!list || list->size() < 2 || list->size() > 4)
      fail(value,
           fmt::format("`{}` must be a number or 2 to 4 of them, not {}", key.str(), describe_node(value)));
    else
      for (const toml::node& element : *list) parameter.values.push_back(number(element));
    all.push_back(std::move(parameter));
  }
  return all;
}

TexturePtr Reader::texture(const toml::node& node) {
  const toml::table* table = node.as_table();
  if (!table) return plain_texture(vector<3>(node, true), sources_);
  const TextureType* named = nullptr;
  for (const TextureType* type : sources_.textures) {
    if (!type->parse || !table->contains(type->name)) continue;
    if (named) return mismatch(node), nullptr;
    named = type;
  }
  if (named && named->is_flat()) return texture(*named, *table);
  if (!named || table->size() != 1) return mismatch(node), nullptr;
  const toml::node& own = *table->get(named->name);
  if (const toml::table* keys = own.as_table()) return texture(*named, *keys);
  std::vector<std::string_view> names;
  for (const Key& key : named->keys) names.push_back(key.name);
  fail(own, fmt::format("`{}` must be a table of `{}`, not {}", named->name, fmt::join(names, "`, `"),
                        describe_node(own)));
  return nullptr;
}

TexturePtr Reader::texture(const TextureType& type, const toml::table& table) {
  // The colors in the texture's table have the range of the key that the texture is for. No texel of an image
  // is above 1.
  std::vector<Key> keys(type.keys.begin(), type.keys.end());
  for (Key& key : keys)
    if (key.type == KeyType::color || key.type == KeyType::color_map) key.max = std::min(key.max, key_.max);
  const std::string title = fmt::format("{{ {} = … }}", type.name);
  TableReader reader =
      read_table({.title = title, .table = &table, .keys = {keys}, .sources = sources_}, log_);
  TexturePtr texture = type.parse(reader);
  ok_ = ok_ && texture && !reader.failed();
  return texture;
}

Mat4 Reader::matrix(const toml::node& node) {
  Mat4 map(1.0);
  const toml::array* rows = node.as_array();
  if (!rows || rows->size() != 3) return mismatch(node), map;
  for (int row = 0; row < 3; ++row) {
    const Vec4 values = vector<4>((*rows)[static_cast<size_t>(row)]);
    for (int column = 0; column < 4; ++column) map[column][row] = values[column];
  }
  return map;
}

Value Reader::value(const toml::node& node) {
  switch (key_.type) {
    case KeyType::boolean:
      if (!node.is_boolean()) mismatch(node);
      return node.value_or(false);
    case KeyType::integer:
      return integer(node);
    case KeyType::number:
      if (!key_.word.empty() && node.value<std::string_view>() == key_.word) return std::string(key_.word);
      return number(node);
    case KeyType::string:
      if (!node.is_string()) mismatch(node);
      return node.value_or(std::string());
    case KeyType::choice:
      return choice(node);
    case KeyType::choice2:
      return choice2(node);
    case KeyType::vec2:
      return vector<2>(node);
    case KeyType::vec3:
      return vector<3>(node);
    case KeyType::vec2_list:
      return vector_list<2>(node);
    case KeyType::vec3_list:
      return vector_list<3>(node);
    case KeyType::outlines:
      return vector_lists(node);
    case KeyType::rows:
      return rows(node);
    case KeyType::formula:
      if (!node.is_string()) return mismatch(node), formula::FormulaText{};
      return formula::FormulaText{node.value_or(std::string()), start_of_text(node)};
    case KeyType::formula_file:
      return formula_file(node);
    case KeyType::parameters:
      return parameters(node);
    case KeyType::color_map:
      return color_map(node);
    case KeyType::keyframes:
      if (!node.is_array() || node.as_array()->empty()) mismatch(node);
      return true;
    case KeyType::color:
      return vector<3>(node, true);
    case KeyType::texture:
      return texture(node);
    case KeyType::scale2:
      return vector<2>(node, true);
    case KeyType::scale3:
      return vector<3>(node, true);
    case KeyType::transform:
      if (!node.is_array()) return mismatch(node), Mat4(1.0);
      if (const auto matrix = read_transform(*node.as_array(), log_, sources_)) return *matrix;
      return ok_ = false, Mat4(1.0);
    case KeyType::rotation:
      if (!node.is_table()) return mismatch(node), Mat4(1.0);
      if (const auto turn = read_rotation(*node.as_table(), log_, sources_)) return *turn;
      return ok_ = false, Mat4(1.0);
    case KeyType::matrix:
      return matrix(node);
  }
  return false;
}

}  // namespace

std::optional<Value> read_value(const Key& key, const toml::node& node, DiagnosticLog& log,
                                const ValueSources& sources) {
  Key ranged = key;
  if (key.type == KeyType::color || key.type == KeyType::color_map || key.type == KeyType::texture)
    ranged.min = std::max(ranged.min, 0.0);
  Reader reader(ranged, log, sources);
  Value value = reader.value(node);
  if (!reader.ok()) return std::nullopt;
  return value;
}

}  // namespace eyeray::engine::reading
