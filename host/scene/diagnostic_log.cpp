#include "scene/diagnostic_log.hpp"

#include <algorithm>
#include <utility>

namespace eyeray {

namespace {

// More would hide the first ones, and a generated file of a million shapes may have a million errors.
constexpr size_t most_diagnostics = 1000;

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

}  // namespace

std::string printable(std::string_view text) {
  std::string clean;
  clean.reserve(text.size());
  while (!text.empty()) {
    const size_t length = codepoint_length(text);
    const auto lead = static_cast<unsigned char>(text[0]);
    const bool control =
        (lead < 0x20 && lead != '\t') || lead == 0x7f || (lead == 0xc2 && length == 2 && text[1] < '\xa0');
    if (length == 0 || control) {
      clean += '?';
    } else {
      clean += text.substr(0, length);
    }
    text.remove_prefix(std::max<size_t>(1, length));
  }
  return clean;
}

std::string_view DiagnosticLog::add_source(std::string file, std::string text) {
  sources_.push_back({std::move(file), std::move(text), {}});
  return sources_.back().text;
}

void DiagnosticLog::error(SourcePosition position, std::string message) {
  add(Severity::error, std::move(position), std::move(message));
}

void DiagnosticLog::warning(SourcePosition position, std::string message) {
  add(Severity::warning, std::move(position), std::move(message));
}

void DiagnosticLog::add(Severity severity, SourcePosition position, std::string message) {
  // Settle where it is.
  if (position.file.empty() && !sources_.empty()) position = {sources_.front().file, 0, 0};
  if (source_index(position.file) == sources_.size()) position.line = position.column = 0;

  // Drop what was said before, and what nobody would read.
  if (!seen_.insert(fmt::format("{}:{}:{}:{}", position.file, position.line, position.column, message))
           .second)
    return;
  if (severity == Severity::error) ++errors_;
  if (diagnostics_.size() >= most_diagnostics) return;

  // In copies of a group the same thing is wrong once: the first of them stands for all.
  if (const std::string subject = subject_ ? subject_() : ""; !subject.empty())
    message = fmt::format("{}: {}", subject, message);
  Diagnostic diagnostic{severity, std::move(position), printable(message), "", 1};
  show_line(diagnostic);
  diagnostics_.push_back(std::move(diagnostic));
}

size_t DiagnosticLog::source_index(std::string_view file) const {
  size_t i = 0;
  while (i < sources_.size() && sources_[i].file != file) ++i;
  return i;
}

void DiagnosticLog::show_line(Diagnostic& diagnostic) {
  const SourcePosition& at = diagnostic.position;
  if (at.line <= 0) return;
  Source& source = sources_[source_index(at.file)];

  // Index the lines once: a large file may have many diagnostics.
  if (source.lines.empty()) {
    source.lines.push_back(0);
    for (size_t i = source.text.find('\n'); i != std::string::npos; i = source.text.find('\n', i + 1)) {
      source.lines.push_back(i + 1);
    }
  }
  const auto row = static_cast<size_t>(at.line) - 1;
  if (row >= source.lines.size()) return;
  const size_t end = std::min(source.text.find('\n', source.lines[row]), source.text.size());
  std::string_view line = std::string_view(source.text).substr(source.lines[row], end - source.lines[row]);
  if (line.ends_with('\r')) line.remove_suffix(1);

  // Cut a long line to a window around the column. Such lines hold numbers: a byte is a column, near enough;
  // the cut is moved to the start of a character.
  if (line.size() > 2 * window) {
    const size_t middle = std::min(line.size(), static_cast<size_t>(std::max(at.column, 1)));
    size_t start = middle > window ? middle - window : 0;
    while (start > 0 && (static_cast<unsigned char>(line[start]) & 0xc0) == 0x80) --start;
    diagnostic.source_line = printable(line.substr(start, 2 * window));
    diagnostic.source_column = static_cast<int>(start) + 1;
    if (start + 2 * window < line.size()) diagnostic.source_line += "…";
  } else {
    diagnostic.source_line = printable(line);
  }
}

std::vector<Diagnostic> DiagnosticLog::sorted() const {
  // Keep the errors if there are any: warnings beside them may be consequences.
  std::vector<Diagnostic> chosen;
  for (const Diagnostic& diagnostic : diagnostics_) {
    if (diagnostic.severity == Severity::error || !has_errors()) chosen.push_back(diagnostic);
  }

  // Read from top to bottom.
  std::ranges::stable_sort(chosen, {}, [&](const Diagnostic& diagnostic) {
    const SourcePosition& at = diagnostic.position;
    return std::tuple(source_index(at.file), at.line, at.column);
  });
  if (errors_ > chosen.size() && !chosen.empty()) {
    chosen.push_back({Severity::error,
                      {chosen.back().position.file, 0, 0},
                      fmt::format("… and {} more errors", errors_ - chosen.size()),
                      "",
                      1});
  }
  return chosen;
}

}  // namespace eyeray
