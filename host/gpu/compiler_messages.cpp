#include "host/gpu/compiler_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <filesystem>
#include <map>
#include <sstream>

namespace eyeray::engine::gpu {
namespace {

bool is_word(char c) {
  return std::isalnum(uint8_t(c)) || c == '_';
}

// The column (from 1) of `token` as a whole word of `line`; 0 when it is not there.
int column_of(std::string_view token, std::string_view line) {
  if (token.empty()) return 0;
  for (size_t at = line.find(token); at != std::string_view::npos; at = line.find(token, at + 1)) {
    const size_t end = at + token.size();
    const bool begins = at == 0 || !is_word(token.front()) || !is_word(line[at - 1]);
    const bool ends = end == line.size() || !is_word(token.back()) || !is_word(line[end]);
    if (begins && ends) return int(at) + 1;
  }
  return 0;
}

// The column (from 1) of the sign that "syntax error, unexpected RIGHT_BRACE, …" names; 0 unless the message
// names a sign that the line has exactly once.
int column_of_unexpected(std::string_view message, std::string_view line) {
  static const std::map<std::string_view, char> signs = {
      {"LEFT_PAREN", '('},   {"RIGHT_PAREN", ')'}, {"LEFT_BRACKET", '['}, {"RIGHT_BRACKET", ']'},
      {"LEFT_BRACE", '{'},   {"RIGHT_BRACE", '}'}, {"DOT", '.'},          {"COMMA", ','},
      {"COLON", ':'},        {"SEMICOLON", ';'},   {"EQUAL", '='},        {"BANG", '!'},
      {"DASH", '-'},         {"TILDE", '~'},       {"PLUS", '+'},         {"STAR", '*'},
      {"SLASH", '/'},        {"PERCENT", '%'},     {"LEFT_ANGLE", '<'},   {"RIGHT_ANGLE", '>'},
      {"VERTICAL_BAR", '|'}, {"CARET", '^'},       {"AMPERSAND", '&'},    {"QUESTION", '?'},
  };
  constexpr std::string_view mark = "unexpected ";
  const size_t at = message.find(mark);
  if (at == std::string_view::npos) return 0;
  message.remove_prefix(at + mark.size());
  const auto sign = signs.find(message.substr(0, message.find_first_of(", ")));
  if (sign == signs.end() || std::count(line.begin(), line.end(), sign->second) != 1) return 0;
  return int(line.find(sign->second)) + 1;
}

// Splits "file:12: message"; the file itself may hold colons. False when there is no such position.
bool split_position(std::string_view text, SourcePosition& position, std::string_view& message) {
  for (size_t colon = text.find(':'); colon != std::string_view::npos; colon = text.find(':', colon + 1)) {
    int line = 0;
    const char* digits = text.data() + colon + 1;
    const auto [end, error] = std::from_chars(digits, text.data() + text.size(), line);
    if (error != std::errc{} || end == text.data() + text.size() || *end != ':') continue;
    position = {std::string(text.substr(0, colon)), line, 0};
    message = text.substr(size_t(end - text.data()) + 1);
    message.remove_prefix(std::min(message.find_first_not_of(' '), message.size()));
    return true;
  }
  return false;
}

// If an error concerns a row of a registry, for instance `sphere_intersect`, its line has only the registry's
// macro. Then this sets the position to that of the name in the row's file, shapes/sphere.glsl. Returns an
// addition to the message; "" if the token belongs to no row.
std::string locate_row(SourcePosition& position, std::string_view token, const ShaderSource& source) {
  const std::pair<const std::string, std::string>* row = nullptr;
  size_t longest = 0;
  for (const auto& file : source.files) {
    const std::string stem = std::filesystem::path(file.first).stem().string() + "_";
    if (!token.starts_with(stem) || stem.size() <= longest) continue;
    row = &file;
    longest = stem.size();
  }
  if (!row || row->first == position.file) return "";
  std::string user = fmt::format(", which {}:{} needs", position.file, position.line);
  position = {row->first, 1, 0};
  std::istringstream lines{row->second};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const int column = column_of(token, line.substr(0, line.find("//")));
    if (column == 0) continue;
    position.line = number;
    position.column = column;
    break;
  }
  return user;
}

// Returns the text to print beside the message.
std::string locate(Diagnostic& diagnostic, std::string_view message, const ShaderSource& source) {
  const auto file = source.files.find(diagnostic.position.file);
  if (file == source.files.end()) return "";
  std::string beside;
  std::string line = line_of(file->second, diagnostic.position.line);
  for (size_t open = message.find('\''); open != std::string_view::npos && diagnostic.position.column == 0;) {
    const size_t close = message.find('\'', open + 1);
    if (close == std::string_view::npos) break;
    const std::string_view token = message.substr(open + 1, close - open - 1);
    diagnostic.position.column = column_of(token, line);
    if (diagnostic.position.column == 0) beside = locate_row(diagnostic.position, token, source);
    if (!beside.empty()) {
      line = line_of(source.files.find(diagnostic.position.file)->second, diagnostic.position.line);
      break;
    }
    open = message.find('\'', close + 1);
  }
  if (diagnostic.position.column == 0) diagnostic.position.column = column_of_unexpected(message, line);
  show_source_line(diagnostic, line);
  return beside;
}

// "'foo' : undeclared identifier " as people write it: "'foo': undeclared identifier".
std::string tidy(std::string_view message) {
  std::string text(message.substr(0, message.find_last_not_of(" \r") + 1));
  if (text.starts_with("'' : ")) text.erase(0, text.find_first_not_of(' ', 5));
  if (const size_t at = text.find("' : "); at != std::string::npos) text.erase(at + 1, 1);
  return text;
}

}  // namespace

std::string more_errors(size_t count) {
  return fmt::format(" (and {} more errors)", count);
}

std::vector<Diagnostic> parse_compiler_messages(std::string_view log, const ShaderSource& source) {
  std::vector<Diagnostic> diagnostics;
  std::istringstream lines{std::string(log)};
  size_t errors = 0, warnings = 0;
  for (std::string line; std::getline(lines, line);) {
    const bool warning = line.starts_with("WARNING: ");
    if (!warning && !line.starts_with("ERROR: ")) continue;
    std::string_view text = line;
    text.remove_prefix(warning ? 9 : 7);
    if (text.find("compilation errors.  No code generated.") != std::string_view::npos)
      continue;  // the line that counts the errors
    if (++(warning ? warnings : errors) > most_messages) continue;

    Diagnostic& diagnostic = diagnostics.emplace_back();
    diagnostic.severity = warning ? Severity::warning : Severity::error;
    diagnostic.position.file = source.entry;
    std::string_view message = text;
    std::string beside;
    if (split_position(text, diagnostic.position, message)) beside = locate(diagnostic, message, source);
    diagnostic.message = tidy(message) + beside;
  }
  if (errors > most_messages) {
    const auto last =
        std::ranges::find(diagnostics.rbegin(), diagnostics.rend(), Severity::error, &Diagnostic::severity);
    last->message += more_errors(errors - most_messages);
  }
  return diagnostics;
}

}  // namespace eyeray::engine::gpu
