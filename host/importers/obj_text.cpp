#include "host/importers/obj_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace eyeray::engine::importers {

namespace {

// An option of a map.
struct MapOption {
  std::string_view name;
  size_t most;                                   // number of values; a number may be missing
  bool has_numbers = true;                       // false: its value is a word
  std::array<std::string_view, 3> neutral = {};  // values that change nothing
  bool counts = false;                           // true: eyeray follows it
};
constexpr MapOption map_options[] = {
    {"-s", 3, true, {"1", "1", "1"}, true},
    {"-o", 3, true, {"0", "0", "0"}, true},
    {"-clamp", 1, false, {"off"}, true},
    {"-t", 3, true, {"0", "0", "0"}},
    {"-mm", 2, true, {"0", "1"}},
    {"-boost", 1, true, {"0"}},
    {"-bm", 1, true, {"1"}},
    {"-texres", 2},
    {"-blendu", 1, false, {"on"}},
    {"-blendv", 1, false, {"on"}},
    {"-cc", 1, false, {"off"}},
    {"-imfchan", 1, false},
    {"-type", 1, false},
    {"-colorspace", 1, false},
};

// Statements that name a picture begin with one of these.
constexpr std::string_view map_statements[] = {"map_", "bump", "disp", "decal", "refl", "norm"};
// The maps that eyeray shows. It leaves the others out, whatever their options are.
constexpr std::string_view shown_maps[] = {"map_Kd", "map_Ke", "map_d", "norm"};
// The maps whose option -bm eyeray follows.
constexpr std::string_view bump_maps[] = {"map_Bump", "map_bump", "bump"};
// The colours that eyeray reads.
constexpr std::string_view color_statements[] = {"Kd", "Ks", "Ke", "Tf"};

constexpr std::string_view spaces = " \t";

// The line without spaces around it.
std::string_view trimmed(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(spaces), line.size()));
  return line.substr(0, line.find_last_not_of(spaces) + 1);
}

// Takes the next word of the line.
std::string_view take_word(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(spaces), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(spaces));
  line.remove_prefix(word.size());
  return word;
}

bool is_number(std::string_view word) {
  double value = 0;
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [after, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error != std::errc::invalid_argument && after == word.data() + word.size() && !word.empty();
}

// True if two words are the same, or the same number.
bool is_same(std::string_view a, std::string_view b) {
  if (!is_number(a) || !is_number(b)) return a == b;
  double x = 0, y = 0;
  std::from_chars(a.data() + (a[0] == '+'), a.data() + a.size(), x);
  std::from_chars(b.data(), b.data() + b.size(), y);
  return x == y;
}

template <size_t N>
bool is_one_of(std::string_view word, const std::string_view (&words)[N]) {
  return std::ranges::find(words, word) != std::end(words);
}

// Adds the options and the picture's name of a map to the text.
void append_map(std::string_view statement, std::string_view line, MtlText& mtl) {
  const bool shown = is_one_of(statement, shown_maps), bumps = is_one_of(statement, bump_maps);
  for (;;) {
    std::string_view rest = line;
    const std::string_view word = take_word(rest);
    const auto option = std::ranges::find(map_options, word, &MapOption::name);
    if (option == std::end(map_options)) break;
    line = rest;
    std::string values;
    bool changes = option->neutral[0].empty();
    for (size_t count = 0; count < option->most; ++count) {
      const std::string_view value = take_word(rest);
      // The last word is the picture's name.
      const bool given = option->has_numbers ? is_number(value) : !trimmed(rest).empty();
      const std::string_view counted = given ? value : option->neutral[count];
      if (given) line = rest;
      rest = line;
      changes = changes || !is_same(counted, option->neutral[count]);
      values.append(" ").append(counted);
    }
    if (option->counts || (bumps && option->name == "-bm")) {
      mtl.text.append(" ").append(word).append(values);
    } else if (shown && changes) {
      mtl.left_out.insert("the option " + std::string(word) + " of maps");
    }
  }
  line = trimmed(line);
  if (line.size() > 2 && line.front() == '"' && line.back() == '"') line = line.substr(1, line.size() - 2);
  mtl.text.append(" ").append(line);
}

void append_line(std::string_view line, MtlText& mtl) {
  std::string_view rest = line;
  const std::string_view statement = take_word(rest);
  const auto starts = [&](std::string_view start) { return statement.starts_with(start); };
  if (std::ranges::any_of(map_statements, starts)) {
    mtl.text += statement;
    return append_map(statement, rest, mtl);
  }
  std::string_view values = rest;
  const std::string_view first = take_word(values);
  if (statement == "d" && first == "-halo") {
    mtl.left_out.insert("the halo of transparency (d -halo)");
    mtl.text.append("d").append(values);
  } else if (is_one_of(statement, color_statements) && (first == "spectral" || first == "xyz")) {
    mtl.left_out.insert("colours by `" + std::string(first) + "`: write " + std::string(statement) +
                        " with three numbers, R G B");
  } else {
    mtl.text += line;
  }
}

}  // namespace

void end_lines_with_newlines(std::string& text) {
  for (size_t at = 0; (at = text.find('\r', at)) != std::string::npos; ++at)
    if (at + 1 == text.size() || text[at + 1] != '\n') text[at] = '\n';
}

MtlText plain_mtl(std::string_view mtl) {
  MtlText plain;
  plain.text.reserve(mtl.size());
  while (!mtl.empty()) {
    const size_t end = mtl.find('\n');
    std::string_view line = mtl.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    append_line(line, plain);
    if (end == std::string_view::npos) break;
    plain.text += '\n';
    mtl.remove_prefix(end + 1);
  }
  return plain;
}

}  // namespace eyeray::engine::importers
