// Reads a line of text from front to back. It takes a line of any length, where std::regex recurses for each
// character.
#pragma once

#include <initializer_list>
#include <optional>
#include <string_view>
#include <vector>

namespace eyeray::engine {

class TextScanner {
 public:
  explicit TextScanner(std::string_view text) : rest_(text) {}

  // The text that has not been read yet.
  std::string_view rest() const { return rest_; }

  // Reads `token` where it comes next; false if it does not.
  bool skip(std::string_view token);
  // Reads white space, if any.
  void skip_spaces();
  // Reads the longest run of letters of ASCII, digits, `_` and characters of `more`; empty if there is none.
  std::string_view word(std::string_view more = "");
  // Reads the first word of `words` that comes next as a whole word; empty if none does.
  std::string_view one_of(std::initializer_list<std::string_view> words);
  // Reads a decimal number, such as `-1_000`, `.5` or `2e-3`. Nothing if there is none, or one that no double
  // holds.
  std::optional<double> number();
  // Reads up to `token`, and `token`; returns the text before it. Reads nothing and returns nothing if it
  // does not come.
  std::optional<std::string_view> before(std::string_view token);

 private:
  std::string_view rest_;
};

// All numbers in a text.
std::vector<double> numbers_in(std::string_view text);
// The number that a text consists of; nothing if it is no number.
std::optional<double> number_of(std::string_view text);

}  // namespace eyeray::engine
