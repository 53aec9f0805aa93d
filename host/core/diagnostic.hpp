// Errors and warnings about a text that a person wrote (scene or shader), shown as compilers show them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/error.hpp"

namespace eyeray::engine {

// A position in a text; line and column count from 1, 0 where unknown.
struct SourcePosition {
  std::string file;
  int line = 0;
  int column = 0;
};

enum class Severity { warning, error };

struct Diagnostic {
  Severity severity = Severity::error;
  SourcePosition position;
  std::string message;
  std::string source_line;  // the line as written, shown with a caret; may be empty
  int source_column = 1;    // the column at which source_line starts, where a long line was cut
};

// Line `number` (from 1) of a text without its end, or "".
std::string line_of(std::string_view text, int number);

// Fills source_line with `line`, which starts at `first_column`: in printable form and, if it is long, cut to
// a window around the diagnostic's column.
void show_source_line(Diagnostic& diagnostic, std::string_view line, int first_column = 1);

// `text` as valid UTF-8 without control characters (tabs stay), so that it can be shown on any terminal and
// in JSON.
std::string printable(std::string_view text);

// "scene.toml:12:5: error: message", then the source line and a caret under the column, without a final
// newline.
std::string format_diagnostic(const Diagnostic& diagnostic);

// Everything wrong with an input, thrown in one go; `what()` is all diagnostics, a line or more each.
class InputError : public Error {
 public:
  explicit InputError(std::vector<Diagnostic> diagnostics);
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

// The candidate that was most likely meant by `word` (Damerau-Levenshtein distance of at most a third of its
// length, at least 1), or "" when none is near.
std::string nearest_name(std::string_view word, std::span<const std::string_view> candidates);

}  // namespace eyeray::engine
