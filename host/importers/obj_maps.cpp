#include "host/importers/obj_maps.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace eyeray::engine::importers {

namespace {

struct NumberedOption {
  std::string_view name;
  std::array<std::string_view, 3> defaults;
  size_t most;
};
constexpr NumberedOption numbered_options[] = {
    {"-s", {"1", "1", "1"}, 3},
    {"-o", {"0", "0", "0"}, 3},
    {"-t", {"0", "0", "0"}, 3},
    {"-mm", {"0", "1"}, 2},
};

// Statements that name a picture begin with one of these.
constexpr std::string_view map_statements[] = {"map_", "bump", "disp", "decal", "refl", "norm"};

// Takes the next word of the line, with the spaces before it.
std::string_view take_word(std::string_view& line) {
  const size_t start = std::min(line.find_first_not_of(" \t\r"), line.size());
  const size_t end = std::min(line.find_first_of(" \t\r", start), line.size());
  const std::string_view word = line.substr(0, end);
  line.remove_prefix(end);
  return word;
}

std::string_view without_spaces(std::string_view word) {
  word.remove_prefix(std::min(word.find_first_not_of(" \t\r"), word.size()));
  return word;
}

bool is_number(std::string_view word) {
  double value = 0;
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [after, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error != std::errc::invalid_argument && after == word.data() + word.size() && !word.empty();
}

bool is_map(std::string_view statement) {
  for (const std::string_view start : map_statements)
    if (statement.starts_with(start)) return true;
  return false;
}

void append_map(std::string_view line, std::string& text) {
  while (!line.empty()) {
    const std::string_view word = take_word(line);
    text += word;
    for (const NumberedOption& option : numbered_options) {
      if (without_spaces(word) != option.name) continue;
      size_t count = 0;
      for (; count < option.most; ++count) {
        std::string_view after = line;
        const std::string_view number = take_word(after);
        if (!is_number(without_spaces(number))) break;
        text += number;
        line = after;
      }
      for (; count < option.most; ++count) text.append(" ").append(option.defaults[count]);
    }
  }
}

}  // namespace

std::string with_all_map_numbers(std::string_view mtl) {
  std::string text;
  text.reserve(mtl.size());
  while (!mtl.empty()) {
    const size_t end = mtl.find('\n');
    const std::string_view line = mtl.substr(0, end);
    std::string_view rest = line;
    if (is_map(without_spaces(take_word(rest)))) {
      append_map(line, text);
    } else {
      text += line;
    }
    if (end == std::string_view::npos) break;
    text += '\n';
    mtl.remove_prefix(end + 1);
  }
  return text;
}

}  // namespace eyeray::engine::importers
