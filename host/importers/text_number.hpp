// Reads numbers in the text of a mesh file. Private to the importers.
#pragma once

#include <charconv>
#include <cstdlib>

#include "host/importers/malformed.hpp"

namespace eyeray::engine::importers {

inline bool is_text_space(char c) {
  return c == ' ' || c == '\n' || c == '\r' || c == '\t';
}

// The position of the next byte that is no space, or the text's end.
inline size_t skip_spaces(std::string_view text, size_t at) {
  while (at < text.size() && is_text_space(text[at])) ++at;
  return at;
}

// Returns the number behind spaces at `at`, and moves `at` behind the number. A NUL must follow `text`, as it
// follows those of a string. InputError at the byte if there is no number.
inline double take_number(std::string_view text, size_t& at, const std::string& file) {
  at = skip_spaces(text, at);
  if (at == text.size()) throw malformed_at(file, text, at, "the file ends too early");
  if (text[at] == '+') ++at;
  double value = 0;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value);
  const auto after = static_cast<size_t>(end - text.data());
  if (error == std::errc::invalid_argument || (after < text.size() && !is_text_space(text[after])))
    throw malformed_at(file, text, at, "this is not a number");
  if (error == std::errc::result_out_of_range) value = std::strtod(text.data() + at, nullptr);  // 0 or ±inf
  at = after;
  return value;
}

}  // namespace eyeray::engine::importers
