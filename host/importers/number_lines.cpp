#include "host/importers/number_lines.hpp"

#include <fmt/format.h>

#include <charconv>
#include <utility>

#include "host/importers/malformed.hpp"
#include "host/importers/text_number.hpp"

namespace eyeray::engine::importers {

namespace {

bool ends_line(char c) {
  return c == '\n' || c == '\r';
}

}  // namespace

bool NumberLines::next() {
  if (std::exchange(begun_, true)) at_ = end_of(at_);
  for (;;) {
    at_ = skip_spaces(text_, at_);
    start_ = at_;
    if (at_ == text_.size()) return false;
    if (text_[at_] != '#' && !text_.substr(at_).starts_with("//")) return true;
    at_ = end_of(at_);
  }
}

void NumberLines::read(std::vector<double>& numbers, size_t most) {
  numbers.clear();
  while (skip_blanks()) {
    if (numbers.size() == most)
      throw malformed_at(file_, text_, at_, fmt::format("a line has at most {} numbers", most));
    numbers.push_back(take_number(text_, at_, file_));
  }
}

std::string_view NumberLines::word() {
  if (!skip_blanks()) return {};
  const size_t begin = at_;
  while (at_ < text_.size() && !is_text_space(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

bool NumberLines::skip_word(std::string_view wanted) {
  const size_t before = at_;
  if (word() == wanted) return true;
  at_ = before;
  return false;
}

bool NumberLines::has_number() const {
  double value = 0;
  const size_t at = start_ + (text_[start_] == '+');
  return std::from_chars(text_.data() + at, text_.data() + text_.size(), value).ec !=
         std::errc::invalid_argument;
}

void NumberLines::fail(const std::string& message) const {
  throw malformed_at(file_, text_, start_, message);
}

size_t NumberLines::end_of(size_t at) const {
  while (at < text_.size() && !ends_line(text_[at])) ++at;
  return at;
}

// Goes to the next word of the line. False at the line's end, or at a comment.
bool NumberLines::skip_blanks() {
  while (at_ < text_.size() && is_text_space(text_[at_]) && !ends_line(text_[at_])) ++at_;
  return at_ < text_.size() && !ends_line(text_[at_]) && text_[at_] != '#';
}

}  // namespace eyeray::engine::importers
