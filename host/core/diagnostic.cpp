#include "core/diagnostic.hpp"

#include <algorithm>
#include <array>

namespace eyeray {

namespace {

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

// Insertions, deletions, substitutions and swaps of neighbours that turn a into b (optimal string alignment).
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

std::string format_diagnostic(const Diagnostic& diagnostic) {
  const SourcePosition& at = diagnostic.position;

  // Say where, what kind, what.
  std::string text = at.file;
  if (at.line > 0) text += fmt::format(":{}", at.line);
  if (at.line > 0 && at.column > 0) text += fmt::format(":{}", at.column);
  if (!text.empty()) text += ": ";
  text += diagnostic.severity == Severity::error ? "error: " : "warning: ";
  text += diagnostic.message;
  if (diagnostic.source_line.empty()) return text;

  // Show the line, and a caret under the column.
  const std::string_view cut = diagnostic.source_column > 1 ? "…" : "";
  text += fmt::format("\n  {}{}", cut, diagnostic.source_line);
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
  if (word.empty() || word.size() > longest) return "";
  size_t best = std::max<size_t>(1, word.size() / 3) + 1;
  std::string_view nearest;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > longest) continue;
    const size_t distance = edit_distance(word, candidate);
    if (distance < best) {
      best = distance;
      nearest = candidate;
    }
  }
  return std::string(nearest);
}

}  // namespace eyeray
