#include "host/reading/toml_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "host/reading/source_position.hpp"
#include "host/reading/statements.hpp"

namespace eyeray::engine::reading {

namespace {

// A damaged file is parsed again after each error, at most `most_repairs` times. A file of more than
// `largest_repaired` bytes is parsed only once.
constexpr int most_repairs = 50;
constexpr size_t largest_repaired = size_t{1} << 20;

constexpr std::string_view redefinition = "cannot redefine existing ";

// The key to which `path` leads in `tree`; of a list of tables, the last table counts. Null if there is none.
const toml::key* find_key(const toml::table& tree, const std::vector<std::string>& path) {
  const toml::table* table = &tree;
  const toml::key* found = nullptr;
  for (const std::string& part : path) {
    if (!table) return nullptr;
    const auto entry = table->find(part);
    if (entry == table->cend()) return nullptr;
    found = &entry->first;
    const toml::node* node = &entry->second;
    if (const toml::array* list = node->as_array(); list && !list->empty())
      node = list->get(list->size() - 1);
    table = node->as_table();
  }
  return found;
}

// The position of the first definition of the key or table that `statement` defines again.
std::optional<SourcePosition> first_definition(const std::string& text, const Statement& statement) {
  const auto tree = [&]() -> std::optional<toml::table> {
    try {
      return toml::parse(std::string_view(text).substr(0, statement.begin));
    } catch (const toml::parse_error&) {
      return std::nullopt;
    }
  }();
  if (!tree) return std::nullopt;
  std::vector<std::string> path = statement.header;
  if (!statement.is_header) path.insert(path.end(), statement.key.begin(), statement.key.end());
  const toml::key* key = find_key(*tree, path);
  if (!key || !key->source().begin) return std::nullopt;
  return position_of(key->source());
}

// The name in quotes in the message, or "".
std::string quoted_name(std::string_view message) {
  const size_t open = message.find('\'');
  const size_t close = message.rfind('\'');
  return open == close ? "" : std::string(message.substr(open + 1, close - open - 1));
}

void report(const toml::parse_error& error, const std::string& text, const Statement& statement,
            const std::string& name, DiagnosticLog& log) {
  SourcePosition at = position_of(error.source());
  at.file = name;
  const std::string_view line =
      std::string_view(text).substr(statement.begin, statement.end - statement.begin);
  std::string message = explain_syntax(error.description(), line);

  // Name both positions of a key given twice.
  if (message.starts_with(redefinition)) {
    if (const auto first = first_definition(text, statement)) {
      const std::string what =
          fmt::format("{}", fmt::join(statement.is_header ? statement.header : statement.key, "."));
      log.error({name, at.line, statement.column},
                fmt::format("{}`{}` is given twice; line {} has it already",
                            statement.is_header ? "the table " : "", what, first->line));
    } else {
      log.error(at, fmt::format("`{}` is given twice", quoted_name(message)));  // the key is inside a value
    }
    return;
  }

  // Report an open value at its beginning, not at the position where the parser noticed it.
  if (statement.line < at.line) {
    log.error({name, statement.line, statement.column},
              fmt::format("syntax: this value does not end: {}, in line {}", message, at.line));
    return;
  }
  log.error(at, "syntax: " + message);
}

}  // namespace

std::string explain_syntax(std::string_view description, std::string_view statement) {
  // Swap the parts of "Error while parsing WHERE: REASON".
  constexpr std::string_view prefix = "Error while parsing ";
  std::string where;
  std::string what(description);
  if (const size_t colon = description.find(": ");
      description.starts_with(prefix) && colon != std::string_view::npos) {
    where = description.substr(prefix.size(), colon - prefix.size());
    what = description.substr(colon + 2);
  }
  if (what.find("invalid utf-8") != std::string::npos) return "the text from here on is not UTF-8";

  // Add advice for known errors.
  const auto says = [&](std::string_view part) { return what.find(part) != std::string::npos; };
  const std::string_view line = statement.substr(0, statement.find('\n'));
  if (where == "table header" && line.find("[[") != std::string_view::npos &&
      line.find("]]") == std::string_view::npos) {
    return what + "; write [[name]], two brackets on each side";
  }
  if (where == "floating-point" && !says("interpreted"))
    return what + "; write digits on both sides of the point: 0.5, 1.0";
  if (says("expected 'true'") || says("expected 'false'") || says("could not determine value type")) {
    return "this is not a value; put a text in quotes: \"…\"";
  }
  if (where == "string" && says("unescaped control")) return "this text has no closing quote on its line";
  if (where == "key-value pair" && says("end-of-file")) return "a value is missing";
  if (says("maximum nested value depth")) return "lists and tables are nested too deep";
  if (where == "inline table" && says("saw '\\n'")) return what + "; { … } must be on one line";
  return what;
}

toml::table parse_toml(std::string_view original, const std::string& name, TreeBudget& budget,
                       DiagnosticLog& log) {
  // Refuse text whose tree would be too deep for the stack or too large for memory.
  if (const auto excess = find_excess(original, budget)) {
    log.error({name, excess->line, excess->column}, excess->message);
    log.set_damaged();
    return {};
  }

  // Parse. After an error, leave the statement out and parse again, so that one run reports all errors.
  std::string text(original);
  for (int repairs = 0;; ++repairs) {
    try {
      return toml::parse(text, name);
    } catch (const toml::parse_error& error) {
      log.set_damaged();
      if (text.size() > largest_repaired) {
        log.error({name, static_cast<int>(error.source().begin.line),
                   static_cast<int>(error.source().begin.column)},
                  "syntax: " + explain_syntax(error.description()));
        return {};
      }
      const Statement statement = statement_at(text, static_cast<int>(error.source().begin.line));
      report(error, text, statement, name, log);
      if (repairs == most_repairs) return {};
      blank(text, statement);
    }
  }
}

}  // namespace eyeray::engine::reading
