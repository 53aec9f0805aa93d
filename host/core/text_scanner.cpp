#include "host/core/text_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <string>

namespace eyeray::engine {
namespace {

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

bool is_of_word(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

// The length of the digits, and of `_` after a digit, that begin at `at`.
size_t digits(std::string_view text, size_t at) {
  size_t end = at;
  while (end < text.size() && (is_digit(text[end]) || (text[end] == '_' && end > at))) ++end;
  return end - at;
}

// The length of the number that begins the text, 0 if none does.
size_t number_length(std::string_view text) {
  const auto is = [&](size_t at, std::string_view characters) {
    return at < text.size() && characters.find(text[at]) != std::string_view::npos;
  };
  size_t at = is(0, "+-") ? 1 : 0;
  const size_t whole = digits(text, at);
  at += whole;
  const size_t part = is(at, ".") ? digits(text, at + 1) : 0;
  if (whole + part == 0) return 0;
  if (is(at, ".")) at += 1 + part;
  if (!is(at, "eE")) return at;
  const size_t exponent = at + (is(at + 1, "+-") ? 2 : 1);
  const size_t length = digits(text, exponent);
  return length ? exponent + length : at;
}

}  // namespace

bool TextScanner::skip(std::string_view token) {
  if (!rest_.starts_with(token)) return false;
  rest_.remove_prefix(token.size());
  return true;
}

void TextScanner::skip_spaces() {
  rest_.remove_prefix(size_t(std::ranges::find_if_not(rest_, is_space) - rest_.begin()));
}

std::string_view TextScanner::word(std::string_view more) {
  const auto end = std::ranges::find_if_not(
      rest_, [&](char c) { return is_of_word(c) || more.find(c) != std::string_view::npos; });
  const std::string_view read = rest_.substr(0, size_t(end - rest_.begin()));
  rest_.remove_prefix(read.size());
  return read;
}

std::string_view TextScanner::one_of(std::initializer_list<std::string_view> words) {
  TextScanner ahead = *this;
  const std::string_view read = ahead.word();
  if (std::ranges::find(words, read) == words.end()) return {};
  *this = ahead;
  return read;
}

std::optional<double> TextScanner::number() {
  const size_t length = number_length(rest_);
  std::string text(rest_.substr(0, length));
  std::erase_if(text, [](char c) { return c == '_' || c == '+'; });  // which from_chars takes none of
  rest_.remove_prefix(length);
  double value = 0;
  if (std::from_chars(text.data(), text.data() + text.size(), value).ec != std::errc()) return {};
  return value;
}

std::optional<std::string_view> TextScanner::before(std::string_view token) {
  const size_t at = rest_.find(token);
  if (at == std::string_view::npos) return {};
  const std::string_view read = rest_.substr(0, at);
  rest_.remove_prefix(at + token.size());
  return read;
}

std::vector<double> numbers_in(std::string_view text) {
  std::vector<double> numbers;
  for (TextScanner scanner(text); !scanner.rest().empty();) {
    const size_t left = scanner.rest().size();
    if (const auto number = scanner.number()) numbers.push_back(*number);
    if (scanner.rest().size() == left) scanner.skip(scanner.rest().substr(0, 1));
  }
  return numbers;
}

std::optional<double> number_of(std::string_view text) {
  TextScanner scanner(text);
  const auto number = scanner.number();
  return scanner.rest().empty() ? number : std::nullopt;
}

}  // namespace eyeray::engine
