#include "host/reading/statements.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>

#include <algorithm>

namespace eyeray::engine::reading {

namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}
bool is_bare(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
}

void skip_space(std::string_view& text) {
  while (!text.empty() && is_space(text[0])) text.remove_prefix(1);
}

// Takes a key such as `a."b c".d` off the front of `text`. Returns its parts; none if there is no key.
std::vector<std::string> take_key(std::string_view& text) {
  std::vector<std::string> parts;
  for (;;) {
    skip_space(text);
    size_t length = 0;
    if (!text.empty() && (text[0] == '"' || text[0] == '\'')) {
      const size_t close = text.find(text[0], 1);
      if (close == std::string_view::npos) return {};
      parts.emplace_back(text.substr(1, close - 1));
      length = close + 1;
    } else {
      while (length < text.size() && is_bare(text[length])) ++length;
      if (length == 0) return {};
      parts.emplace_back(text.substr(0, length));
    }
    text.remove_prefix(length);
    skip_space(text);
    if (text.empty() || text[0] != '.') return parts;
    text.remove_prefix(1);
  }
}

// The kind of statement that a line starts, if any.
struct Start {
  bool is_header = false;
  std::vector<std::string> parts;
};
std::optional<Start> parse_start(std::string_view line) {
  skip_space(line);
  const bool header = line.starts_with('[');
  if (header) line.remove_prefix(line.starts_with("[[") ? 2 : 1);

  // Reject a list of numbers, which may start a line inside a value. Names of tables do not start with a
  // digit or a sign.
  skip_space(line);
  if (header && !line.empty() && !(is_bare(line[0]) && line[0] != '-' && !(line[0] >= '0' && line[0] <= '9')))
    return {};
  std::vector<std::string> parts = take_key(line);
  if (parts.empty()) return {};
  if (header) return line.starts_with(',') ? std::nullopt : std::optional(Start{true, std::move(parts)});
  return line.starts_with('=') ? std::optional(Start{false, std::move(parts)}) : std::nullopt;
}

bool parses(std::string_view text) {
  try {
    (void)toml::parse(text);
    return true;
  } catch (const toml::parse_error&) {
    return false;
  }
}

// The whole text as statements. Text before the first statement belongs to none.
std::vector<Statement> split(std::string_view text) {
  std::vector<Statement> all;
  std::vector<std::string> header;
  int line = 0;
  for (size_t begin = 0; begin < text.size();) {
    ++line;
    const size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    const std::string_view row = text.substr(begin, end - begin);
    if (const auto start = parse_start(row)) {
      if (start->is_header) header = start->parts;
      const auto indent = std::ranges::find_if_not(row, is_space) - row.begin();
      all.push_back({begin, text.size(), line, static_cast<int>(indent) + 1, start->is_header, header,
                     start->is_header ? std::vector<std::string>() : start->parts});
      if (all.size() > 1) all[all.size() - 2].end = begin;
    }
    begin = end;
  }
  return all;
}

Statement whole_line(std::string_view text, int line) {
  size_t begin = 0;
  for (int i = 1; i < line && begin < text.size(); ++i)
    begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
  return {begin, std::min(text.find('\n', begin), text.size()), line, 1, false, {}, {}};
}

}  // namespace

Statement statement_at(std::string_view text, int line) {
  const std::vector<Statement> all = split(text);
  auto found = std::ranges::upper_bound(all, line, {}, &Statement::line);
  if (found == all.begin()) return whole_line(text, line);
  --found;

  // If a statement starts at the line of the error, the statement before it may still be open.
  if (found != all.begin() && found->line == line) {
    const Statement& before = *std::prev(found);
    if (!parses(text.substr(before.begin, before.end - before.begin))) return before;
  }

  // Blame only this line if the statement before it is complete.
  const Statement rest = whole_line(text, line);
  if (found->line < line && parses(text.substr(found->begin, rest.begin - found->begin))) return rest;

  // Take a table as a whole: without its header, its keys would belong to the table before it.
  Statement statement = *found;
  if (statement.is_header) {
    const auto next =
        std::find_if(found + 1, all.end(), [](const Statement& other) { return other.is_header; });
    statement.end = next == all.end() ? text.size() : next->begin;
  }
  return statement;
}

void blank(std::string& text, const Statement& statement) {
  for (size_t i = statement.begin; i < statement.end; ++i) {
    if (text[i] != '\n') text[i] = ' ';
  }
}

std::optional<Excess> find_excess(std::string_view text, TreeBudget& budget) {
  // The measured cost of each item in toml++, in the budget's units. Each part of a key may be a separate
  // table.
  constexpr size_t of_comma = 1, of_list = 2, of_table = 4, of_key_part = 8;

  int line = 1;
  size_t line_begin = 0;
  int parts = 1;  // number of parts of a possible key
  int depth = 0;  // number of open brackets
  bool blank = true, header = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const auto excess = [&](std::string message) {
      return Excess{line, static_cast<int>(i - line_begin) + 1, std::move(message)};
    };
    size_t cost = 0;
    switch (c) {
      case '\n':
        ++line;
        line_begin = i + 1;
        parts = 1;
        blank = true;
        header = false;
        continue;
      case '#':
        i = std::min(text.find('\n', i), text.size()) - 1;
        continue;
      case '"':
      case '\'': {
        // Step over a string in single or triple quotes.
        const std::string_view quotes = text.substr(i, text.substr(i).starts_with(std::string(3, c)) ? 3 : 1);
        size_t end = i + quotes.size();
        while (end < text.size() && !text.substr(end).starts_with(quotes) &&
               (quotes.size() == 3 || text[end] != '\n')) {
          if (c == '"' && text[end] == '\\') ++end;
          if (end < text.size() && text[end] == '\n') {
            ++line;
            line_begin = end + 1;
          }
          ++end;
        }
        i = end + quotes.size() - 1;
        if (quotes.size() == 1 && end < text.size() && text[end] == '\n') --i;
        break;
      }
      case '.':
        if (++parts > most_key_parts)
          return excess(fmt::format(
              "a key can have at most {} parts; to nest groups deeper, use [[instance]]", most_key_parts));
        if (header) cost = of_key_part;
        break;
      case '=':
        cost = of_key_part * static_cast<size_t>(parts);
        parts = 1;
        break;
      case '[':
      case '{':
        cost = c == '[' ? of_list : of_table;
        if (c == '[' && blank && depth == 0) header = true;
        if (!header) ++depth;
        parts = 1;
        break;
      case ']':
      case '}':
        if (!header && depth > 0) --depth;
        parts = 1;
        break;
      case ',':
        cost = of_comma;
        parts = 1;
        break;
      default:
        break;
    }
    if (!is_space(c)) blank = false;
    if (cost > budget.left)
      return excess(
          "the scene has more keys and values than eyeray reads; a batch needs fewer, a mesh file hardly "
          "any");
    budget.left -= cost;
  }
  return std::nullopt;
}

}  // namespace eyeray::engine::reading
