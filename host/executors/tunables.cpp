#include "host/executors/tunables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "host/core/text_scanner.hpp"
#include "host/executors/control.hpp"

namespace eyeray::engine::executors {
namespace {

// The value of a text as simple as "0.5f", "true" or "vec3(1, 0.5f, 0)"; nothing for other text.
std::optional<Tunable::Value> value_of(Tunable::Type type, std::string_view text) {
  if (type == Tunable::Type::boolean) {
    if (text != "true" && text != "false") return std::nullopt;
    return Tunable::Value{text == "true" ? 1.0 : 0.0};
  }
  if (type != Tunable::Type::vector) {
    if (text.ends_with('f') || text.ends_with('F')) text.remove_suffix(1);
    const std::optional<double> number = number_of(text);
    return number ? std::optional(Tunable::Value{*number}) : std::nullopt;
  }
  if (!text.starts_with("vec3(") || !text.ends_with(")")) return std::nullopt;
  const std::vector<double> numbers = numbers_in(text.substr(5));
  if (numbers.size() == 1) return Tunable::Value{numbers[0], numbers[0], numbers[0]};
  if (numbers.size() != 3) return std::nullopt;
  return Tunable::Value{numbers[0], numbers[1], numbers[2]};
}

std::string in_glsl(Tunable::Type type, const Tunable::Value& value) {
  switch (type) {
    case Tunable::Type::floating:
      return fmt::format("float({:.9g})", value[0]);
    case Tunable::Type::integer:
      return fmt::format("{:.0f}", value[0]);
    case Tunable::Type::boolean:
      return value[0] != 0 ? "true" : "false";
    case Tunable::Type::vector:
      return fmt::format("vec3({:.9g}, {:.9g}, {:.9g})", value[0], value[1], value[2]);
  }
  return "";
}

std::string read_from_buffer(Tunable::Type type, size_t index) {
  const std::string record = fmt::format("tunables[{}]", index);
  switch (type) {
    case Tunable::Type::floating:
      return record + ".x";
    case Tunable::Type::integer:
      return fmt::format("int({}.x)", record);
    case Tunable::Type::boolean:
      return fmt::format("({}.x != 0.0f)", record);
    case Tunable::Type::vector:
      return record + ".xyz";
  }
  return "";
}

Tunable::Type type_named(std::string_view name) {
  if (name == "float") return Tunable::Type::floating;
  if (name == "int") return Tunable::Type::integer;
  return name == "bool" ? Tunable::Type::boolean : Tunable::Type::vector;
}

// True if a control of this kind moves values of this type.
bool fits(std::string_view control, Tunable::Type type) {
  if (control == "color") return type == Tunable::Type::vector;
  if (control == "checkbox") return type == Tunable::Type::boolean;
  return type == Tunable::Type::floating || type == Tunable::Type::integer;
}

// `const TYPE NAME = VALUE;` with a control after it.
struct Declaration {
  std::string_view indent, type, name, value, comment;
  Control control;
};
std::optional<Declaration> declaration_in(std::string_view line) {
  const auto control = control_in(line, "//");
  if (!control || !control->value.ends_with(';')) return std::nullopt;
  Declaration found{};
  found.control = *control;
  TextScanner scanner(control->value.substr(0, control->value.size() - 1));
  found.comment = line.substr(control->value.size());
  scanner.skip_spaces();
  found.indent = line.substr(0, line.size() - scanner.rest().size() - found.comment.size() - 1);
  if (scanner.one_of({"const"}).empty()) return std::nullopt;
  scanner.skip_spaces();
  found.type = scanner.one_of({"float", "int", "bool", "vec3"});
  scanner.skip_spaces();
  found.name = scanner.word();
  scanner.skip_spaces();
  if (found.type.empty() || found.name.empty() || !scanner.skip("=")) return std::nullopt;
  scanner.skip_spaces();
  found.value = scanner.rest();
  return found;
}

}  // namespace

void Tunables::begin() {
  found_.clear();
}

size_t Tunables::index_of(const std::string& id) {
  const size_t index = size_t(std::ranges::find(ids_, id) - ids_.begin());
  if (index == ids_.size()) ids_.push_back(id);
  return index;
}

std::string Tunables::apply(const std::string& file, std::string_view text) {
  if (text.find("// @") == std::string_view::npos) return std::string(text);
  std::string result;
  int line_number = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    std::string line(text.substr(begin, end - begin));
    begin = end + 1;
    ++line_number;
    if (const auto declared = declaration_in(line)) {
      const std::string name(declared->name);
      Tunable tunable{file + ":" + name, file, name, line_number, type_named(declared->type), 0, 1, {}};
      const std::vector<double>& range = declared->control.range;
      if (range.size() == 2) tunable.low = range[0], tunable.high = range[1];
      const std::optional<Tunable::Value> written = value_of(tunable.type, declared->value);
      if (written && fits(declared->control.kind, tunable.type) && tunable.low < tunable.high) {
        tunable.written = *written;
        const size_t index = index_of(tunable.id);
        if (as_constants || index >= most)
          line = fmt::format("{}const {} {} = {};{}", declared->indent, declared->type, tunable.name,
                             in_glsl(tunable.type, value(tunable)), declared->comment);
        else
          line = fmt::format("#define {} {}", tunable.name, read_from_buffer(tunable.type, index));
        if (std::ranges::find(found_, tunable.id, &Tunable::id) == found_.end()) found_.push_back(tunable);
      }
    }
    result += line + '\n';
  }
  return result;
}

bool Tunables::choose(std::map<std::string, Tunable::Value> values) {
  if (values == chosen_) return false;
  chosen_ = std::move(values);
  ++choice_;
  return true;
}

Tunable::Value Tunables::value(const Tunable& tunable) const {
  const auto found = chosen_.find(tunable.id);
  return found == chosen_.end() ? tunable.written : found->second;
}

std::array<std::array<float, 4>, Tunables::most> Tunables::records() const {
  std::array<std::array<float, 4>, most> records{};
  for (const Tunable& tunable : found_) {
    const size_t index = size_t(std::ranges::find(ids_, tunable.id) - ids_.begin());
    if (index >= most) continue;
    const Tunable::Value now = value(tunable);
    records[index] = {float(now[0]), float(now[1]), float(now[2]), 0};
  }
  return records;
}

}  // namespace eyeray::engine::executors
