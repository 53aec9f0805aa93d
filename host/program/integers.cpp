#include "host/program/integers.hpp"

#include <charconv>

#include "host/core/error.hpp"

namespace eyeray::engine::program {

bool parse_integers(std::string_view text, char separator, std::span<int> numbers) {
  const char* at = text.data();
  const char* const end = at + text.size();
  for (size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0 && (at == end || *at++ != separator)) return false;
    const auto [next, error] = std::from_chars(at, end, numbers[i]);
    if (error != std::errc()) return false;
    at = next;
  }
  return at == end;
}

std::pair<int, int> parse_size(const std::string& text) {
  int size[2];
  if (!parse_integers(text, 'x', size))
    throw Error(ExitCode::bad_input, "--size must be WIDTHxHEIGHT, such as 640x480, not '{}'", text);
  return {size[0], size[1]};
}

}  // namespace eyeray::engine::program
