#include "host/reading/number_expression.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>

#include "host/core/diagnostic.hpp"

namespace eyeray::engine::reading {

namespace {

using Arguments = std::span<const double>;

// As in GLSL: the result has the sign of the divisor.
double remainder_of(double a, double b) {
  return a - b * std::floor(a / b);
}

// A number from 0 to below 1 that the arguments determine. Steele, Lea, Flood: Fast Splittable Pseudorandom
// Number Generators, 2014: the mixing function of SplitMix64.
double random_of(Arguments arguments) {
  uint64_t state = 0;
  for (const double argument : arguments) {
    state += std::bit_cast<uint64_t>(argument + 0.0) + 0x9e3779b97f4a7c15u;  // −0 is as 0
    state = (state ^ (state >> 30)) * 0xbf58476d1ce4e5b9u;
    state = (state ^ (state >> 27)) * 0x94d049bb133111ebu;
    state ^= state >> 31;
  }
  return double(state >> 11) * 0x1p-53;
}

struct Function {
  std::string_view name, arguments;  // as the manual shows them
  size_t least, most;                // number of arguments
  double (*value)(Arguments);
};

constexpr Function functions[] = {
    {"abs", "x", 1, 1, [](Arguments x) { return std::fabs(x[0]); }},
    {"sign", "x", 1, 1, [](Arguments x) { return double((x[0] > 0) - (x[0] < 0)); }},
    {"floor", "x", 1, 1, [](Arguments x) { return std::floor(x[0]); }},
    {"ceil", "x", 1, 1, [](Arguments x) { return std::ceil(x[0]); }},
    {"round", "x", 1, 1, [](Arguments x) { return std::round(x[0]); }},
    {"fract", "x", 1, 1, [](Arguments x) { return x[0] - std::floor(x[0]); }},
    {"sqrt", "x", 1, 1, [](Arguments x) { return std::sqrt(x[0]); }},
    {"exp", "x", 1, 1, [](Arguments x) { return std::exp(x[0]); }},
    {"log", "x", 1, 1, [](Arguments x) { return std::log(x[0]); }},
    {"pow", "x, y", 2, 2, [](Arguments x) { return std::pow(x[0], x[1]); }},
    {"sin", "x", 1, 1, [](Arguments x) { return std::sin(x[0]); }},
    {"cos", "x", 1, 1, [](Arguments x) { return std::cos(x[0]); }},
    {"tan", "x", 1, 1, [](Arguments x) { return std::tan(x[0]); }},
    {"asin", "x", 1, 1, [](Arguments x) { return std::asin(x[0]); }},
    {"acos", "x", 1, 1, [](Arguments x) { return std::acos(x[0]); }},
    {"atan", "y, x", 1, 2,
     [](Arguments x) { return x.size() == 1 ? std::atan(x[0]) : std::atan2(x[0], x[1]); }},
    {"radians", "x", 1, 1, [](Arguments x) { return x[0] * (std::numbers::pi / 180); }},
    {"degrees", "x", 1, 1, [](Arguments x) { return x[0] * (180 / std::numbers::pi); }},
    {"min", "x, y, …", 2, 16, [](Arguments x) { return *std::ranges::min_element(x); }},
    {"max", "x, y, …", 2, 16, [](Arguments x) { return *std::ranges::max_element(x); }},
    {"clamp", "x, low, high", 3, 3, [](Arguments x) { return std::fmin(std::fmax(x[0], x[1]), x[2]); }},
    {"mix", "x, y, share", 3, 3, [](Arguments x) { return x[0] * (1 - x[2]) + x[1] * x[2]; }},
    {"mod", "x, y", 2, 2, [](Arguments x) { return remainder_of(x[0], x[1]); }},
    {"random", "x, …", 1, 16, random_of},
};
constexpr std::string_view pi_name = "pi";
constexpr int deepest = 64;

bool begins_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool in_name(char c) {
  return begins_name(c) || is_digit(c);
}

// Evaluates a text while it parses it, with the operators and precedences of C.
class Parser {
 public:
  Parser(std::string_view text, const Variables& variables) : text_(text), variables_(variables) {}

  std::vector<double> whole() {
    at_ = 1;  // behind "="
    // The name of a list alone is the list.
    if (const auto* list = lone_list()) return *list;
    const double value = choice();
    if (next() != '\0') fail("an operator is missing here");
    return {value};
  }

 private:
  [[noreturn]] void fail(const std::string& message) { fail(message, at_); }
  [[noreturn]] void fail(const std::string& message, size_t at) { throw ExpressionFault(message, at); }

  // The next character that is no blank, which it does not consume; '\0' at the end.
  char next() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(std::string_view token) {
    next();
    if (!text_.substr(at_).starts_with(token)) return false;
    at_ += token.size();
    return true;
  }
  void expect(char token) {
    if (!take({&token, 1})) fail(fmt::format("`{}` is missing here", token));
  }
  std::string_view name() {
    const size_t begin = at_;
    while (at_ < text_.size() && in_name(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  const std::vector<double>* lone_list() {
    const size_t begin = at_;
    if (begins_name(next())) {
      const auto* value = variables_.find(name());
      if (value && value->size() > 1 && next() == '\0') return value;
    }
    at_ = begin;
    return nullptr;
  }

  double choice() {
    if (++depth_ > deepest) fail(fmt::format("the expression is nested more than {} deep", deepest));
    const double condition = either();
    double value = condition;
    if (take("?")) {
      // The other value is parsed, but it need not exist: a list may end before it.
      const bool counts = counts_;
      counts_ = counts && condition != 0;
      const double yes = choice();
      expect(':');
      counts_ = counts && condition == 0;
      const double no = choice();
      counts_ = counts;
      value = condition != 0 ? yes : no;
    }
    --depth_;
    return value;
  }
  double either() {
    double value = both();
    while (take("||")) value = (both() != 0) | (value != 0);
    return value;
  }
  double both() {
    double value = comparison();
    while (take("&&")) value = (comparison() != 0) & (value != 0);
    return value;
  }
  double comparison() {
    const double left = sum();
    if (take("<=")) return left <= sum();
    if (take(">=")) return left >= sum();
    if (take("==")) return left == sum();
    if (take("!=")) return left != sum();
    if (take("<")) return left < sum();
    if (take(">")) return left > sum();
    return left;
  }
  double sum() {
    double value = product();
    for (;;) {
      if (take("+"))
        value += product();
      else if (take("-"))
        value -= product();
      else
        return value;
    }
  }
  double product() {
    double value = signed_value();
    for (;;) {
      if (take("*"))
        value *= signed_value();
      else if (take("/"))
        value /= signed_value();
      else if (take("%"))
        value = remainder_of(value, signed_value());
      else
        return value;
    }
  }
  double signed_value() {
    bool negative = false;
    while (next() == '-' || next() == '+') negative = negative != (text_[at_++] == '-');
    if (next() == '!' && !text_.substr(at_).starts_with("!=")) {
      ++at_;
      if (++depth_ > deepest) fail(fmt::format("the expression is nested more than {} deep", deepest));
      const double value = signed_value() == 0;
      --depth_;
      return negative ? -value : value;
    }
    const double value = primary();
    return negative ? -value : value;
  }
  double primary() {
    if (take("(")) {
      const double value = choice();
      expect(')');
      return value;
    }
    if (is_digit(next()) || next() == '.') return number();
    if (!begins_name(next())) fail("a number, a name or `(` is missing here");
    const size_t begin = at_;
    const std::string_view word = name();
    if (next() == '(') return call(word, begin);
    if (const auto* value = variables_.find(word)) return element(word, *value, begin);
    if (word == pi_name) return std::numbers::pi;
    unknown(word, begin);
  }
  double number() {
    double value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc()) fail("this is no number");
    at_ = size_t(end - text_.data());
    return value;
  }
  double element(std::string_view word, const std::vector<double>& list, size_t begin) {
    if (list.size() == 1 && next() != '[') return list[0];
    if (!take("["))
      fail(fmt::format("`{0}` is a list of {1} numbers; write {0}[0] to {0}[{2}], or `{0}` alone", word,
                       list.size(), list.size() - 1),
           begin);
    const size_t start = at_;
    const double index = choice();
    expect(']');
    if (index >= 0 && index < double(list.size()) && index == std::floor(index)) return list[size_t(index)];
    if (!counts_) return 0;
    fail(fmt::format("`{}` has no number {}; they count from 0 to {}", word, index, list.size() - 1), start);
  }
  double call(std::string_view word, size_t begin) {
    const auto* const function = std::ranges::find(functions, word, &Function::name);
    if (function == std::end(functions)) unknown(word, begin);
    expect('(');
    std::vector<double> arguments;
    if (next() != ')') {
      do arguments.push_back(choice());
      while (take(","));
    }
    expect(')');
    if (arguments.size() < function->least || arguments.size() > function->most)
      fail(fmt::format("`{}` takes {}, not {} arguments", word,
                       function->least == function->most
                           ? std::to_string(function->least)
                           : fmt::format("{} to {}", function->least, function->most),
                       arguments.size()),
           begin);
    return function->value(arguments);
  }
  [[noreturn]] void unknown(std::string_view word, size_t begin) {
    std::vector<std::string_view> names = variables_.names();
    const bool none = names.empty();
    const std::string known = fmt::format("{}", fmt::join(names, ", "));
    for (const Function& function : functions) names.push_back(function.name);
    names.push_back(pi_name);
    const std::string nearest = nearest_name(word, names);
    fail(fmt::format("`{}` is neither a variable nor a function; {}", word,
                     !nearest.empty() ? fmt::format("did you mean `{}`?", nearest)
                     : none           ? "variables are the keys of [let]"
                                      : fmt::format("the variables are {}", known)),
         begin);
  }

  std::string_view text_;
  const Variables& variables_;
  size_t at_ = 0;
  int depth_ = 0;
  bool counts_ = true;  // false in the branch of a choice that is not taken
};

}  // namespace

const std::vector<double>* Variables::find(std::string_view name) const {
  for (size_t i = loops.size(); i-- > 0;)
    if (loops[i].name == name) return &loops[i].value;
  const auto found = lets_.find(name);
  return found == lets_.end() ? nullptr : &found->second;
}

std::vector<std::string_view> Variables::names() const {
  std::vector<std::string_view> names;
  for (const Loop& loop : loops) names.push_back(loop.name);
  for (const auto& variable : lets_) names.push_back(variable.first);
  return names;
}

std::vector<double> evaluate(std::string_view expression, const Variables& variables) {
  return Parser(expression, variables).whole();
}

std::string why_no_name(std::string_view name) {
  if (name.empty() || !begins_name(name[0]) || !std::ranges::all_of(name, in_name))
    return "a variable's name has letters, digits and _, and begins with no digit";
  if (name == pi_name || std::ranges::find(functions, name, &Function::name) != std::end(functions))
    return fmt::format("`{}` has a meaning in expressions already; choose another name", name);
  return "";
}

std::vector<std::string_view> names_in(std::string_view expression) {
  std::vector<std::string_view> names;
  for (size_t at = 0; at < expression.size();) {
    const size_t begin = at;
    while (at < expression.size() && in_name(expression[at])) ++at;
    if (at > begin && begins_name(expression[begin])) names.push_back(expression.substr(begin, at - begin));
    at += at == begin;
  }
  return names;
}

std::string functions_text() {
  std::vector<std::string> all;
  for (const Function& function : functions)
    all.push_back(fmt::format("`{}({})`", function.name, function.arguments));
  return fmt::format("{} and `{}`", fmt::join(all, ", "), pi_name);
}

}  // namespace eyeray::engine::reading
