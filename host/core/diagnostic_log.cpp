#include "host/core/diagnostic_log.hpp"

#include <algorithm>
#include <utility>

namespace eyeray::engine {

namespace {

// More diagnostics would hide the first ones, and a generated file of a million shapes may have a million
// errors.
constexpr size_t most_diagnostics = 1000;

}  // namespace

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
  // Settle the diagnostic's position.
  if (position.file.empty() && !sources_.empty()) position = {sources_.front().file, 0, 0};
  if (source_index(position.file) == sources_.size()) position.line = position.column = 0;

  // Drop a message that was added before, or one beyond the limit, which nobody would read. The latter is not
  // kept for comparison either.
  std::string text = fmt::format("{}:{}:{}:{}", position.file, position.line, position.column, message);
  if (seen_.contains(text)) return;
  if (severity == Severity::error) ++errors_;
  if (full()) return;
  seen_.insert(std::move(text));

  // Name the subject only now: a fault that recurs in all copies of a group is reported once, for the first.
  if (const std::string subject = subject_ ? subject_() : ""; !subject.empty())
    message = fmt::format("{}: {}", subject, message);
  Diagnostic diagnostic{severity, std::move(position), printable(message), "", 1};
  show_line(diagnostic);
  diagnostics_.push_back(std::move(diagnostic));
}

bool DiagnosticLog::full() const {
  return diagnostics_.size() >= most_diagnostics;
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
  show_source_line(diagnostic, line);
}

std::vector<Diagnostic> DiagnosticLog::sorted() const {
  // Keep the errors if there are any: warnings beside them may be consequences.
  std::vector<Diagnostic> chosen;
  for (const Diagnostic& diagnostic : diagnostics_) {
    if (diagnostic.severity == Severity::error || !has_errors()) chosen.push_back(diagnostic);
  }

  // Sort them as a text is read, from top to bottom.
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

}  // namespace eyeray::engine
