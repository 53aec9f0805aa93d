// Lines of numbers in a text: those of XYZ and OFF files. Private to the importers.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace eyeray::engine::importers {

// The lines of a text that have content. A line ends with LF, CR LF, or CR alone. A comment goes from `#` to
// the end of its line; `//` at the beginning of a line begins one, too.
class NumberLines {
 public:
  // `text` and `file` must outlive this object. A NUL must follow `text`, as it follows that of a string.
  NumberLines(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  // Goes to the next line that is neither empty nor a comment. False at the end of the text.
  bool next();
  // Reads all numbers that are left of the line, at most `most`. InputError at a word that is no number.
  void read(std::vector<double>& numbers, size_t most);
  // Takes the next word of the line. Empty at its end, or before a comment.
  std::string_view word();
  // Takes the next word of the line if it is this one.
  bool skip_word(std::string_view word);

  // True if the line begins with a number.
  bool has_number() const;
  // The whole line, with its comment.
  std::string_view line() const { return text_.substr(start_, end_of(start_) - start_); }
  // InputError at the beginning of the line.
  [[noreturn]] void fail(const std::string& message) const;

 private:
  size_t end_of(size_t at) const;
  bool skip_blanks();

  std::string_view text_;
  const std::string& file_;
  size_t at_ = 0;
  size_t start_ = 0;  // begin of the line
  bool begun_ = false;
};

}  // namespace eyeray::engine::importers
