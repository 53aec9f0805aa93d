// Collects the faults of the files of one scene, so that everything is reported in one go.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine {

class DiagnosticLog {
 public:
  // Keeps the text that positions in `file` point into, for as long as the log lives.
  std::string_view add_source(std::string file, std::string text);

  // Adds a diagnostic; the same one at the same position counts once. A position in a file that was not added
  // (an override) loses its line and column; a position without a file is in the first file.
  void error(SourcePosition position, std::string message);
  void warning(SourcePosition position, std::string message);

  // While an About lives, the log's messages begin with the text that `subject` returns, unless that is "".
  // The innermost About counts.
  class About {
   public:
    About(DiagnosticLog& log, std::function<std::string()> subject)
        : log_(log), outer_(std::exchange(log.subject_, std::move(subject))) {}
    ~About() { log_.subject_ = std::move(outer_); }
    About(const About&) = delete;
    About& operator=(const About&) = delete;

   private:
    DiagnosticLog& log_;
    std::function<std::string()> outer_;
  };

  // Notes that a statement could not be parsed and was skipped. A part that seems to be missing may stand
  // there, so nothing is reported as missing.
  void set_damaged() { damaged_ = true; }
  bool damaged() const { return damaged_; }

  // True if diagnostics added from now on are only counted, so that their text does not matter.
  bool full() const;

  bool has_errors() const { return errors_ > 0; }
  // The errors, or if there are none the warnings: by file, in the order they were added, then by line.
  std::vector<Diagnostic> sorted() const;

 private:
  struct Source {
    std::string file;
    std::string text;
    std::vector<size_t> lines;  // the start of each line; built on first use
  };

  void add(Severity severity, SourcePosition position, std::string message);
  size_t source_index(std::string_view file) const;
  // Finds the line in its file and shows it.
  void show_line(Diagnostic& diagnostic);

  std::deque<Source> sources_;  // a deque, so that texts never move
  std::vector<Diagnostic> diagnostics_;
  std::unordered_set<std::string> seen_;
  std::function<std::string()> subject_;
  size_t errors_ = 0;
  bool damaged_ = false;
};

}  // namespace eyeray::engine
