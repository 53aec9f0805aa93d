#include "host/core/diagnostic.hpp"

#include <algorithm>
#include <array>

#include "host/core/github_text.hpp"

namespace eyeray::engine {

namespace {

// Characters of a long line that are shown on each side of the column.
constexpr size_t window = 60;

// The length of the well-formed UTF-8 sequence at the start of `text`, or 0.
size_t codepoint_length(std::string_view text) {
  const auto byte = [&](size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto tail = [&](size_t i) { return (byte(i) & 0xc0) == 0x80; };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  if (lead >= 0xc2 && lead < 0xe0) return tail(1) ? 2 : 0;
  if (lead >= 0xe0 && lead < 0xf0) {
    const bool overlong = lead == 0xe0 && byte(1) < 0xa0;
    const bool surrogate = lead == 0xed && byte(1) >= 0xa0;
    return tail(1) && tail(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (lead >= 0xf0 && lead < 0xf5) {
    const bool overlong = lead == 0xf0 && byte(1) < 0x90;
    const bool beyond = lead == 0xf4 && byte(1) >= 0x90;
    return tail(1) && tail(2) && tail(3) && !overlong && !beyond ? 4 : 0;
  }
  return 0;
}

// True for a code point that shows nothing, but breaks a line or changes the direction of the text around it.
// Texts of some languages need the joiners U+200C and U+200D: these stay.
bool is_hidden(std::string_view codepoint) {
  if (codepoint == "\u061c" || codepoint == "\ufeff") return true;
  return (codepoint >= "\u200e" && codepoint <= "\u200f") || codepoint == "\u200b" ||
         (codepoint >= "\u2028" && codepoint <= "\u202e") || (codepoint >= "\u2060" && codepoint <= "\u206f");
}

bool continues_codepoint(char c) {
  return (static_cast<unsigned char>(c) & 0xc0) == 0x80;
}

// White space as wide as the first `columns` characters of `line`; tabs stay tabs, so that a caret lines up.
std::string blank_like(std::string_view line, int columns) {
  std::string blank;
  for (const char c : line) {
    if (continues_codepoint(c)) continue;
    if (columns-- <= 0) break;
    blank += c == '\t' ? '\t' : ' ';
  }
  return blank;
}

std::string join(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (!text.empty()) text += '\n';
    text += format_diagnostic(diagnostic);
  }
  return text;
}

// Number of insertions, deletions, substitutions and swaps of neighbours that turn a into b (optimal string
// alignment).
size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    std::swap(before_last, last);
    std::swap(last, row);
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
        row[j] = std::min(row[j], before_last[j - 2] + 1);
      }
    }
  }
  return row[b.size()];
}

}  // namespace

std::string printable(std::string_view text) {
  std::string clean;
  clean.reserve(text.size());
  while (!text.empty()) {
    const size_t length = codepoint_length(text);
    const auto lead = static_cast<unsigned char>(text[0]);
    const bool control =
        (lead < 0x20 && lead != '\t') || lead == 0x7f || (lead == 0xc2 && length == 2 && text[1] < '\xa0');
    if (length == 0 || control || is_hidden(text.substr(0, length))) {
      clean += '?';
    } else {
      clean += text.substr(0, length);
    }
    text.remove_prefix(std::max<size_t>(1, length));
  }
  return clean;
}

std::string line_of(std::string_view text, int number) {
  for (int line = 1; line < number; ++line) {
    const size_t end = text.find('\n');
    if (end == std::string_view::npos) return "";
    text.remove_prefix(end + 1);
  }
  return std::string(text.substr(0, text.find_first_of("\r\n")));
}

void show_source_line(Diagnostic& diagnostic, std::string_view line, int first_column) {
  diagnostic.source_column = first_column;
  if (line.size() <= 2 * window) {
    diagnostic.source_line = printable(line);
    return;
  }

  // Long lines hold numbers, so a byte is near enough to a column. The cut moves to the start of a character.
  const auto column = static_cast<size_t>(std::max(diagnostic.position.column - first_column + 1, 1));
  const size_t middle = std::min(line.size(), column);
  size_t start = middle > window ? middle - window : 0;
  while (start > 0 && start < line.size() && continues_codepoint(line[start])) --start;
  diagnostic.source_line = printable(line.substr(start, 2 * window));
  diagnostic.source_column += static_cast<int>(start);
  if (start + 2 * window < line.size()) diagnostic.source_line += "…";
}

std::string format_diagnostic(const Diagnostic& diagnostic) {
  const SourcePosition& at = diagnostic.position;

  // Write the position, the kind, the message.
  std::string text = at.file;
  if (at.line > 0) text += fmt::format(":{}", at.line);
  if (at.line > 0 && at.column > 0) text += fmt::format(":{}", at.column);
  if (!text.empty()) text += ": ";
  text += diagnostic.severity == Severity::error ? "error: " : "warning: ";
  text = log_line(text + diagnostic.message);
  if (diagnostic.source_line.empty()) return text;

  // Show the line, and a caret under the column.
  const std::string_view cut = diagnostic.source_column > 1 ? "…" : "";
  text += fmt::format("\n  {}{}", cut, log_line(diagnostic.source_line));
  if (at.column >= diagnostic.source_column) {
    const std::string blank = blank_like(diagnostic.source_line, at.column - diagnostic.source_column);
    text += fmt::format("\n  {}{}^", cut.empty() ? "" : " ", blank);
  }
  return text;
}

InputError::InputError(std::vector<Diagnostic> diagnostics)
    : Error(ExitCode::bad_input, join(diagnostics)), diagnostics_(std::move(diagnostics)) {}

std::string nearest_name(std::string_view word, std::span<const std::string_view> candidates) {
  constexpr size_t longest =
      64;  // no name of ours is longer, and the distance costs the product of the lengths
  constexpr size_t most_candidates = 1000;
  if (word.empty() || word.size() > longest) return "";
  size_t best = std::max<size_t>(1, word.size() / 3) + 1, most_alike = 0;
  std::string_view nearest;
  for (const std::string_view candidate : candidates.first(std::min(candidates.size(), most_candidates))) {
    if (candidate.size() > longest) continue;
    const size_t distance = edit_distance(word, candidate);
    // If two names are as near, the one counts that begins as the word does.
    const auto alike = size_t(std::ranges::mismatch(word, candidate).in1 - word.begin());
    if (distance < best || (distance == best && !nearest.empty() && alike > most_alike)) {
      best = distance;
      most_alike = alike;
      nearest = candidate;
    }
  }
  return std::string(nearest);
}

}  // namespace eyeray::engine
