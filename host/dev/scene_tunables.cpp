#include "host/dev/scene_tunables.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <regex>
#include <sstream>

namespace eyeray::engine::dev {
namespace {

const std::regex header(R"(^\s*(\[\[?)\s*([\w.-]+)\s*\]\]?\s*(#.*)?$)");
const std::regex annotated(R"(^\s*([\w.-]+)\s*=\s*(.*?)\s*#\s*@(slider|color|checkbox)\b(.*)$)");
const std::regex naming(R"-(^\s*(name|file)\s*=\s*"([^"\\]+)"\s*(#.*)?$)-");
const std::regex number(R"([-+]?(\d[\d_]*\.?\d*|\.\d+)([eE][-+]?\d+)?)");

std::vector<std::string> numbers_in(const std::string& text) {
  std::vector<std::string> numbers;
  for (std::sregex_iterator i(text.begin(), text.end(), number), end; i != end; ++i) {
    std::string digits = i->str();
    std::erase(digits, '_');
    numbers.push_back(digits);
  }
  return numbers;
}

// Reads the type and value from the text of a key's value; false if the control cannot set such values.
bool read_value(const std::string& control, const std::string& text, SceneTunable& tunable) {
  const std::vector<std::string> numbers = numbers_in(text);
  if (control == "checkbox") {
    tunable.type = "bool";
    tunable.written[0] = text == "true";
    return text == "true" || text == "false";
  }
  if (control == "color") {
    tunable.type = "vec3";
    if (!text.starts_with('[') || numbers.size() != 3) return false;
    std::ranges::transform(numbers, tunable.written.begin(),
                           [](const std::string& x) { return std::stod(x); });
    return true;
  }
  if (!std::regex_match(text, number)) return false;
  tunable.type = text.find_first_of(".eE") == std::string::npos ? "int" : "float";
  tunable.written[0] = std::stod(numbers[0]);
  return true;
}

// The parts of a key: "material", "0" and "diffuse.formula.parameters.size". The number is the index of a
// table in its array.
struct Parts {
  std::string table, number, rest;
  std::string instance() const { return table + "." + number; }
};
Parts parts_of(const std::string& key) {
  static const std::regex form(R"(([^.]+)\.(?:(\d+)\.)?(.*))");
  std::smatch match;
  return std::regex_match(key, match, form) ? Parts{match[1], match[2], match[3]} : Parts{"", "", key};
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
    std::smatch match;
    if (std::regex_match(line, match, header)) {
      const std::string name = match[2];
      const std::string array = name.substr(0, name.find('.'));
      if (match[1] == "[[")
        table = name + "." + std::to_string(counts[name]++) + ".";
      else if (const auto of = counts.find(array); of != counts.end())
        table = array + "." + std::to_string(of->second - 1) + name.substr(array.size()) + ".";
      else
        table = name + ".";
    } else if (std::regex_match(line, match, annotated)) {
      SceneTunable tunable{table + match[1].str(), "", "", "", 0, 1, {}};
      if (!read_value(match[3], match[2], tunable)) continue;
      const std::vector<std::string> range = numbers_in(match[4]);
      if (range.size() == 2) tunable.low = std::stod(range[0]), tunable.high = std::stod(range[1]);
      if (tunable.low < tunable.high) found.push_back(std::move(tunable));
    } else if (std::regex_match(line, match, naming)) {
      const Parts parts = parts_of(table + "name");
      if (parts.number.empty() || parts.rest != "name") continue;
      if (match[1] == "name")
        called[parts.instance()] = match[2];
      else
        called.try_emplace(parts.instance(), std::filesystem::path(match[2].str()).stem().string());
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
