#include "host/formula/text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <functional>
#include <optional>
#include <set>

#include "host/core/diagnostic.hpp"
#include "host/formula/vocabulary.hpp"
#include "host/gpu/compiler_messages.hpp"

namespace eyeray::engine::formula {

namespace {

// These limits bound the depth to which a compiler recurses. The largest text compiles in a fraction of
// a second.
constexpr size_t most_bytes = size_t{1} << 16;
constexpr size_t most_nesting = 64;
constexpr size_t most_links = 500;
constexpr size_t most_elements = 1024;
constexpr size_t most_functions = 256;
// `const in` is the longest that has a meaning.
constexpr size_t most_qualifiers = 2;
// Limit on the elements in comparisons of arrays, which are written out element by element.
constexpr size_t most_compared = size_t{1} << 15;

class Judge {
 public:
  Judge(Text& text, FormulaKind kind, std::vector<Fault>& faults) : t_(text), kind_(kind), faults_(faults) {}

  void run() {
    if (!pair_brackets()) return;
    find_functions();
    for (size_t i = 0; i < t_.tokens.size(); ++i)
      if (t_.tokens[i].kind == Token::Kind::word) t_.is_name[i] = judge_word(i);
    judge_arrays();
    judge_chains();
    judge_qualifiers();
    judge_globals();
    judge_entries();
    find_unset();
  }

 private:
  static constexpr size_t none = size_t(-1);
  struct Function {
    size_t type;  // index of the token; the name and the parenthesis follow
    bool defined;
  };

  bool is(size_t i, std::string_view what) const { return i < t_.tokens.size() && t_.tokens[i].is(what); }
  bool is_word(size_t i) const { return i < t_.tokens.size() && t_.tokens[i].kind == Token::Kind::word; }
  bool type_at(size_t i) const { return is_word(i) && is_type(text(i)); }
  const std::string& text(size_t i) const { return t_.tokens[i].text; }
  // True for if, else, for and while: the statement that follows is a part of this one.
  bool chains(size_t i) const { return is(i, "if") || is(i, "else") || is(i, "for") || is(i, "while"); }
  bool opens(size_t i) const { return is(i, "(") || is(i, "[") || is(i, "{"); }
  void fail(size_t i, std::string message) {
    faults_.push_back({t_.tokens[i].line, t_.tokens[i].column, std::move(message)});
  }

  bool pair_brackets();
  void find_functions();
  bool judge_word(size_t i);
  void judge_arrays();
  std::vector<size_t> declared_at(size_t i) const;
  std::optional<size_t> size_written_at(size_t i) const;
  void judge_chains();
  void judge_qualifiers();
  void judge_globals();
  void judge_entries();
  void find_unset();
  void add_unset(size_t behind, size_t type, size_t name, bool is_parameter);
  bool defines(const Entry& entry) const;
  std::optional<size_t> uncalled(std::string_view function) const;

  Text& t_;
  FormulaKind kind_;
  std::vector<Fault>& faults_;
  std::vector<size_t> partner_;  // index of each bracket's counterpart; `none` for other tokens
  std::vector<Function> functions_;
  std::set<std::string, std::less<>> own_;  // the functions' names
};

bool Judge::pair_brackets() {
  partner_.resize(t_.tokens.size(), none);
  std::vector<size_t> open;
  for (size_t i = 0; i < t_.tokens.size(); ++i) {
    if (t_.tokens[i].kind != Token::Kind::sign) continue;
    const char c = text(i)[0];
    if (c == '(' || c == '[' || c == '{') open.push_back(i);
    if (open.size() > most_nesting) {
      fail(i, fmt::format("brackets can be nested at most {} deep: give a part of the expression a name",
                          most_nesting));
      return false;
    }
    if (c != ')' && c != ']' && c != '}') continue;
    const char wanted = c == ')' ? '(' : c == ']' ? '[' : '{';
    if (open.empty() || text(open.back())[0] != wanted) {
      fail(i, fmt::format("this '{}' has no opening bracket", c));
      return false;
    }
    partner_[i] = open.back();
    partner_[open.back()] = i;
    open.pop_back();
  }
  if (!open.empty()) fail(open.back(), fmt::format("this '{}' is never closed", text(open.back())));
  return open.empty();
}

// Finds each TYPE NAME ( … ) at the top level.
void Judge::find_functions() {
  for (size_t i = 0; i < t_.tokens.size(); ++i) {
    if (type_at(i) && is_word(i + 1) && is(i + 2, "(")) {
      const size_t close = partner_[i + 2];
      functions_.push_back({i, is(close + 1, "{")});
      own_.insert(text(i + 1));
      if (functions_.size() == most_functions + 1)
        fail(i, fmt::format("a formula can have at most {} functions", most_functions));
      i = close;
    } else if (opens(i)) {
      i = partner_[i];
    }
  }
}

// True if the word at i is a user-defined name.
bool Judge::judge_word(size_t i) {
  const std::string& word = text(i);
  if (i > 0 && is(i - 1, ".")) {
    if (!is_swizzle(word)) fail(i, fmt::format("'.{}' is not a component of a vector", word));
    return false;
  }
  if (is_type(word) || is_keyword(word)) return false;
  if (is_refused(word)) {
    fail(i, fmt::format("'{}' cannot be used in a formula", word));
    return false;
  }
  if (word.starts_with("gl_")) fail(i, fmt::format("'{}' is not defined here", word));
  if (!is(i + 1, "(") || own_.contains(word)) return true;
  if (is_built_in(word)) return false;
  if (word == "PROBE") {
    fail(i, "PROBE is for shaders: to see a value of a formula, return it");
    return false;
  }
  if (faults_.size() >= gpu::most_messages) {
    faults_.push_back({t_.tokens[i].line, t_.tokens[i].column, ""});  // only counted
    return false;
  }
  std::vector<std::string_view> known(built_in_functions().begin(), built_in_functions().end());
  known.insert(known.end(), own_.begin(), own_.end());
  const std::string nearest = nearest_name(word, known);
  fail(i, fmt::format("there is no function '{}' here{}", word,
                      nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
  return false;
}

// The number N of [ N ] at i, if every reader understands the same by it: decimal, without a leading 0.
// Nothing for other numbers, and above most_elements.
std::optional<size_t> Judge::size_written_at(size_t i) const {
  if (!is(i + 2, "]") || t_.tokens[i + 1].kind != Token::Kind::integer) return std::nullopt;
  const std::string& digits = text(i + 1);
  size_t size = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), size);
  if (error != std::errc() || end != digits.data() + digits.size() || digits[0] == '0') return std::nullopt;
  return size <= most_elements ? std::optional(size) : std::nullopt;
}

// The positions of the names that TYPE at i declares: TYPE NAME, NAME [ SIZE ] = …, NAME; none for a
// function.
std::vector<size_t> Judge::declared_at(size_t i) const {
  std::vector<size_t> names;
  if (!type_at(i) || !is_word(i + 1) || is(i + 2, "(")) return names;
  names.push_back(i + 1);
  for (size_t k = i + 2; k < t_.tokens.size() && !is(k, ";"); ++k) {
    if (opens(k))
      k = partner_[k];
    else if (partner_[k] != none || (type_at(k) && is_word(k + 1)))
      break;  // the enclosing bracket closes, or the next declaration begins
    else if (is(k, ",") && is_word(k + 1) && !is_type(text(k + 1)))
      names.push_back(k + 1);
  }
  return names;
}

// Judges the sizes in TYPE NAME [ SIZE ] and float[2](1, 2), and the comparisons of arrays, which take one
// instruction per element.
void Judge::judge_arrays() {
  size_t largest = 0, comparisons = 0;
  const auto judge = [&](size_t open, bool may_be_empty) {
    const size_t close = partner_[open];
    const bool empty = may_be_empty && close == open + 1;
    const auto size = size_written_at(open);
    if (!size && !empty)
      fail(open - 1, fmt::format("the size of an array must be a decimal number from 1 to {}, written out",
                                 most_elements));
    if (is(close + 1, "[")) fail(close + 1, "arrays of arrays are not supported");
    // A list without a size has no more elements than tokens.
    largest = std::max(largest, size.value_or(empty ? partner_[close + 1] - close : 0));
  };
  for (size_t i = 0; i + 1 < t_.tokens.size(); ++i) {
    comparisons += is(i, "==") || is(i, "!=");
    if (!type_at(i)) continue;
    if (is(i + 1, "[")) {
      const bool list = is(partner_[i + 1] + 1, "(");
      if (!list) fail(i, fmt::format("write the size of an array after its name: {} name[…]", text(i)));
      judge(i + 1, list);
    }
    for (const size_t name : declared_at(i))
      if (is(name + 1, "[")) judge(name + 1, false);
  }
  if (largest * comparisons > most_compared)
    faults_.push_back(
        {1, 1,
         fmt::format("comparing arrays of {} elements {} times is too much: compare elements in a loop",
                     largest, comparisons)});
}

// Limits the length of chains such as a + b + … and if … else if …, since compilers recurse as deeply. The
// chains of all statements around a statement count with its own. The elements of a list, such as a call's
// arguments, form no chain with each other.
void Judge::judge_chains() {
  struct Bracket {
    size_t links;  // the chain's length where the bracket opens
    bool is_list;
  };
  std::vector<Bracket> open;
  size_t links = 0;
  const auto add_link = [&](size_t i) {
    if (++links == most_links + 1)
      fail(i, fmt::format("a statement can have at most {} operators: split it", most_links));
  };
  for (size_t i = 0; i < t_.tokens.size(); ++i) {
    const size_t base = open.empty() ? 0 : open.back().links;
    const char c = text(i)[0];
    const bool is_sign = t_.tokens[i].kind == Token::Kind::sign;
    if (opens(i)) {
      const bool is_call =
          is(i, "(") && i > 0 && (is(i - 1, "]") || (is_word(i - 1) && !is_keyword(text(i - 1))));
      // In a[1][0] and f(p)[0] a compiler recurses one level deeper for each such bracket.
      if (!is(i, "{") && i > 0 && (is(i - 1, ")") || is(i - 1, "]"))) add_link(i);
      open.push_back({links, is_call});
    } else if (is_sign && (c == ')' || c == ']')) {
      links = base;
      open.pop_back();
    } else if (is(i, "}")) {
      open.pop_back();
      links = is(i + 1, "else") ? base : open.empty() ? 0 : open.back().links;
    } else if (is(i, ";")) {
      if (!is(i + 1, "else")) links = base;
    } else if (is(i, ",") && !open.empty() && open.back().is_list) {
      links = base;
    } else if (is_sign || chains(i)) {
      add_link(i);
    }
  }
}

// Limits the qualifiers before a type: a compiler reports each that is too many.
void Judge::judge_qualifiers() {
  size_t count = 0;
  for (size_t i = 0; i < t_.tokens.size(); ++i) {
    const bool qualifier = is(i, "const") || is(i, "in") || is(i, "out") || is(i, "inout");
    count = qualifier ? count + 1 : 0;
    if (count == most_qualifiers + 1)
      fail(i, fmt::format("a type can have at most {} qualifiers, such as `const in`", most_qualifiers));
  }
}

// Refuses global variables that are not const: with them f would depend on earlier calls.
void Judge::judge_globals() {
  bool constant = false;
  for (size_t i = 0; i < t_.tokens.size(); ++i) {
    if (is(i, "const")) constant = true;
    if (is(i, ";") || is(i, "}")) constant = false;
    if (type_at(i) && is_word(i + 1) && !is(i + 2, "(") && !constant)
      fail(i + 1,
           fmt::format("'{}' must be const: outside of functions a formula has no variables", text(i + 1)));
    if (opens(i)) i = partner_[i];
  }
}

// True if the text defines TYPE NAME(TYPE a, …) { … } with the types of entry.written.
bool Judge::defines(const Entry& entry) const {
  return std::ranges::any_of(functions_, [&](const Function& function) {
    size_t i = function.type;
    if (!function.defined || !is(i, entry.type) || !is(i + 1, entry.name)) return false;
    const size_t close = partner_[i + 2];
    i += 2;
    for (std::string_view written = entry.written; !written.empty();) {
      for (++i; is(i, "const") || is(i, "in");) ++i;
      if (!is(i, written.substr(0, written.find(' ')))) return false;
      i += 2;
      const size_t comma = written.find(", ");
      written = comma == std::string_view::npos ? "" : written.substr(comma + 2);
      if (!written.empty() && !is(i, ",")) return false;
    }
    return i == close;
  });
}

// The token of the function's name where the text defines it; none if the text also calls it.
std::optional<size_t> Judge::uncalled(std::string_view function) const {
  std::optional<size_t> definition;
  for (size_t i = 0; i < t_.tokens.size(); ++i) {
    if (!is(i, function) || !is(i + 1, "(")) continue;
    const auto declared = std::ranges::find(functions_, i - 1, &Function::type);
    if (declared == functions_.end()) return std::nullopt;
    if (declared->defined) definition = i;
  }
  return definition;
}

void Judge::judge_entries() {
  const Entry other = other_entry_of(kind_);
  t_.has_other = kind_ != FormulaKind::color && defines(other);
  if (t_.has_other) t_.uncalled_other = uncalled(other.name);
  if (const Entry entry = entry_of(kind_); !defines(entry))
    faults_.push_back(
        {1, 1,
         fmt::format("the text must have a function `{} {}({})`", entry.type, entry.name, entry.written)});
}

void Judge::add_unset(size_t behind, size_t type, size_t name, bool is_parameter) {
  const size_t length = is(name + 1, "[") ? size_written_at(name + 1).value_or(0) : 0;
  t_.unset.push_back({behind, text(type), length, is_parameter ? text(name) : ""});
}

void Judge::find_unset() {
  for (const Function& function : functions_) {
    if (!function.defined) continue;
    const size_t open = function.type + 2, close = partner_[open], body = close + 1;
    for (size_t i = open; i < close; ++i)
      if (is(i, "out") && is_word(i + 2)) add_unset(body, i + 1, i + 2, true);
    for (size_t i = body; i < partner_[body]; ++i) {
      for (const size_t name : declared_at(i)) {
        const size_t last = is(name + 1, "[") ? partner_[name + 1] : name;
        if (!is(last + 1, "=")) add_unset(last, i, name, false);
      }
    }
  }
  std::ranges::stable_sort(t_.unset, {}, &Text::Unset::token);
}

}  // namespace

Text read_text(std::string_view text, FormulaKind kind, std::vector<Fault>& faults) {
  Text result;
  if (text.size() > most_bytes) {
    faults.push_back({1, 1, fmt::format("a formula can have at most {} bytes", most_bytes)});
    return result;
  }
  result.tokens = tokenize(text, faults);
  result.is_name.resize(result.tokens.size(), false);
  Judge(result, kind, faults).run();
  return result;
}

}  // namespace eyeray::engine::formula
