#include "host/formula/token.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace eyeray::engine::formula {

namespace {

// Signs of several characters, the longest first.
constexpr std::string_view longer[] = {"<<=", ">>=", "++", "--", "+=", "-=", "*=", "/=", "%=", "&=", "|=",
                                       "^=",  "==",  "!=", "<=", ">=", "&&", "||", "^^", "<<", ">>"};
constexpr std::string_view single = "()[]{}.,;+-*/%<>=!?:&|^~";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || is_digit(c);
}

class Tokenizer {
 public:
  Tokenizer(std::string_view text, std::vector<Fault>& faults) : rest_(text), faults_(faults) {}

  std::vector<Token> run() {
    while (!rest_.empty()) {
      const char c = rest_[0];
      if (c == '\n' || c == ' ' || c == '\t' || c == '\r')
        take(1);
      else if (rest_.starts_with("//"))
        line_comment();
      else if (rest_.starts_with("/*"))
        comment();
      else if (is_digit(c) || (c == '.' && rest_.size() > 1 && is_digit(rest_[1])))
        number();
      else if (is_word(c))
        add(Token::Kind::word, size_t(std::ranges::find_if_not(rest_, is_word) - rest_.begin()));
      else if (const auto sign = std::ranges::find_if(longer, [&](auto s) { return rest_.starts_with(s); });
               sign != std::end(longer))
        add(Token::Kind::sign, sign->size());
      else if (single.find(c) != std::string_view::npos)
        add(Token::Kind::sign, 1);
      else
        stray();
    }
    return std::move(tokens_);
  }

 private:
  void take(size_t count) {
    for (const char c : rest_.substr(0, count)) {
      column_ = c == '\n' ? 1 : column_ + 1;
      if (c == '\n') ++line_;
    }
    rest_.remove_prefix(count);
  }
  void add(Token::Kind kind, size_t length) {
    tokens_.push_back({kind, std::string(rest_.substr(0, length)), line_, column_});
    take(length);
  }

  // In GLSL a comment that ends in a backslash continues on the next line, which few readers notice.
  void line_comment() {
    const size_t end = std::min(rest_.find('\n'), rest_.size());
    const size_t last = rest_.find_last_not_of('\r', end == 0 ? 0 : end - 1);
    if (rest_[last] == '\\')
      faults_.push_back({line_, column_ + int(last),
                         "a comment must not end in a backslash: in GLSL the next line would be part of it"});
    take(end);
  }

  void comment() {
    const size_t end = rest_.find("*/", 2);
    if (end == std::string_view::npos) faults_.push_back({line_, column_, "this comment has no end"});
    take(end == std::string_view::npos ? rest_.size() : end + 2);
  }

  // Reads a number: 12, 0x1f, 3u, 1.5, .5, 1e-3, 2.f
  void number() {
    size_t length = 0;
    const auto digits = [&] {
      while (length < rest_.size() && is_digit(rest_[length])) ++length;
    };
    bool decimal = false;
    if (rest_.starts_with("0x") || rest_.starts_with("0X")) {
      length = size_t(std::ranges::find_if_not(rest_, is_word) - rest_.begin());
    } else {
      digits();
      if (length < rest_.size() && rest_[length] == '.') {
        decimal = true;
        ++length;
        digits();
      }
      if (length < rest_.size() && (rest_[length] == 'e' || rest_[length] == 'E')) {
        decimal = true;
        ++length;
        if (length < rest_.size() && (rest_[length] == '+' || rest_[length] == '-')) ++length;
        digits();
      }
      if (length < rest_.size() && (rest_[length] == 'f' || rest_[length] == 'F') && decimal) ++length;
      if (length < rest_.size() && (rest_[length] == 'u' || rest_[length] == 'U') && !decimal) ++length;
    }
    if (const size_t known = length; known < rest_.size() && is_word(rest_[known])) {
      while (length < rest_.size() && is_word(rest_[length])) ++length;
      faults_.push_back(
          {line_, column_,
           fmt::format("'{}' is not a number that a formula can have", rest_.substr(0, length))});
    }
    add(decimal ? Token::Kind::decimal : Token::Kind::integer, length);
  }

  void stray() {
    if (rest_[0] == '#') {
      faults_.push_back({line_, column_, "a formula has no preprocessor: write a const or a function"});
      take(std::min(rest_.find('\n'), rest_.size()));
      return;
    }
    const auto byte = uint8_t(rest_[0]);
    // A character of several bytes is reported once.
    if (byte < 0x80 || byte >= 0xc0)
      faults_.push_back({line_, column_,
                         byte >= 0x20 && byte < 0x7f
                             ? fmt::format("'{}' has no meaning in a formula", rest_[0])
                             : "outside of comments a formula can have only ASCII characters"});
    take(1);
  }

  std::string_view rest_;
  std::vector<Fault>& faults_;
  std::vector<Token> tokens_;
  int line_ = 1;
  int column_ = 1;
};

}  // namespace

std::vector<Token> tokenize(std::string_view text, std::vector<Fault>& faults) {
  return Tokenizer(text, faults).run();
}

}  // namespace eyeray::engine::formula
