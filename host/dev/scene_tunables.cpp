#include "host/dev/scene_tunables.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>

#include "host/core/text_scanner.hpp"
#include "host/executors/control.hpp"

namespace eyeray::engine::dev {
namespace {

// Characters of a TOML key, dotted ones too, beside those of a word.
constexpr std::string_view of_key = ".-";

// True at the line's end and before a comment.
bool ends(TextScanner scanner) {
  scanner.skip_spaces();
  return scanner.rest().empty() || scanner.rest().starts_with('#');
}

struct Header {
  bool in_array = false;
  std::string name;
};
std::optional<Header> header_in(std::string_view line) {
  TextScanner scanner(line);
  scanner.skip_spaces();
  if (!scanner.skip("[")) return std::nullopt;
  Header header{.in_array = scanner.skip("["), .name = ""};
  scanner.skip_spaces();
  header.name = scanner.word(of_key);
  scanner.skip_spaces();
  if (header.name.empty() || !scanner.skip(header.in_array ? "]]" : "]") || !ends(scanner))
    return std::nullopt;
  return header;
}

// `name = "TEXT"`, or `file = "TEXT"`.
struct Naming {
  std::string key, text;
};
std::optional<Naming> naming_in(std::string_view line) {
  TextScanner scanner(line);
  scanner.skip_spaces();
  const std::string_view key = scanner.one_of({"name", "file"});
  scanner.skip_spaces();
  if (key.empty() || !scanner.skip("=")) return std::nullopt;
  scanner.skip_spaces();
  const bool quoted = scanner.skip("\"");
  const auto text = scanner.before("\"");
  if (!quoted || !text || text->empty() || text->find('\\') != std::string_view::npos || !ends(scanner))
    return std::nullopt;
  return Naming{std::string(key), std::string(*text)};
}

// Reads the type and value from the text of a key's value; false if the control cannot set such values.
bool read_value(std::string_view control, std::string_view text, SceneTunable& tunable) {
  if (control == "checkbox") {
    tunable.type = "bool";
    tunable.written[0] = text == "true";
    return text == "true" || text == "false";
  }
  if (control == "color") {
    const std::vector<double> numbers = numbers_in(text);
    tunable.type = "vec3";
    if (!text.starts_with('[') || numbers.size() != 3) return false;
    std::ranges::copy(numbers, tunable.written.begin());
    return true;
  }
  const std::optional<double> number = number_of(text);
  if (!number) return false;
  tunable.type = text.find_first_of(".eE") == std::string_view::npos ? "int" : "float";
  tunable.written[0] = *number;
  return true;
}

// The tunable in a line of the table `table`.
std::optional<SceneTunable> tunable_in(std::string_view line, const std::string& table) {
  const auto control = executors::control_in(line, "#");
  if (!control) return std::nullopt;
  TextScanner scanner(control->value);
  scanner.skip_spaces();
  const std::string_view key = scanner.word(of_key);
  scanner.skip_spaces();
  if (key.empty() || !scanner.skip("=")) return std::nullopt;
  scanner.skip_spaces();
  SceneTunable tunable{table + std::string(key), "", "", "", 0, 1, {}};
  if (control->range.size() == 2) tunable.low = control->range[0], tunable.high = control->range[1];
  if (!read_value(control->kind, scanner.rest(), tunable) || !(tunable.low < tunable.high))
    return std::nullopt;
  return tunable;
}

// The parts of a key: "material", "0" and "diffuse.formula.parameters.size". The number is the index of a
// table in its array.
struct Parts {
  std::string table, number, rest;
  std::string instance() const { return table + "." + number; }
};
Parts parts_of(const std::string& key) {
  TextScanner scanner(key);
  const auto table = scanner.before(".");
  if (!table) return {"", "", key};
  TextScanner after = scanner;
  const auto number = after.before(".");
  const bool is_number =
      number && !number->empty() && number->find_first_not_of("0123456789") == std::string_view::npos;
  return {std::string(*table), is_number ? std::string(*number) : "",
          std::string((is_number ? after : scanner).rest())};
}

// The name of a property: its path without the parts that state only how it is computed.
std::string property_name(const std::string& path) {
  std::string name;
  std::istringstream words(path);
  for (std::string word; std::getline(words, word, '.');)
    if (word != "formula" && word != "parameters") name += (name.empty() ? "" : " ") + word;
  return name;
}

}  // namespace

std::vector<SceneTunable> scene_tunables(std::string_view text) {
  std::vector<SceneTunable> found;
  std::map<std::string, int> counts;          // the number of tables in each array so far
  std::map<std::string, std::string> called;  // the names of these tables, by "material.0"
  std::string table;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    if (const auto header = header_in(line)) {
      const std::string& name = header->name;
      const std::string array = name.substr(0, name.find('.'));
      if (header->in_array)
        table = name + "." + std::to_string(counts[name]++) + ".";
      else if (const auto of = counts.find(array); of != counts.end())
        table = array + "." + std::to_string(of->second - 1) + name.substr(array.size()) + ".";
      else
        table = name + ".";
    } else if (const auto tunable = tunable_in(line, table)) {
      found.push_back(*tunable);
    } else if (const auto naming = naming_in(line)) {
      const Parts parts = parts_of(table + "name");
      if (parts.number.empty() || parts.rest != "name") continue;
      if (naming->key == "name")
        called[parts.instance()] = naming->text;
      else
        called.try_emplace(parts.instance(), std::filesystem::path(naming->text).stem().string());
    }
  }
  for (SceneTunable& tunable : found) {
    const Parts parts = parts_of(tunable.key);
    const auto name = called.find(parts.instance());
    tunable.owner = name != called.end() ? name->second : parts.table;
    if (name == called.end() && !parts.number.empty() && counts[parts.table] > 1)
      tunable.owner += " " + std::to_string(std::stoi(parts.number) + 1);
    tunable.name = property_name(parts.rest);
  }
  return found;
}

}  // namespace eyeray::engine::dev
