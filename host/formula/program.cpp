#include "formula/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "core/diagnostic.hpp"
#include "formula/vocabulary.hpp"

namespace eyeray::formula {

namespace {

// Arrays hold at most so much, so that no stack overflows; loops whose turns are known to be few are not
// counted.
constexpr size_t most_elements = 1024;
constexpr double most_uncounted_turns = 4096;

class Analysis {
 public:
  Analysis(Program& program, std::span<const std::string> parameters, std::vector<Fault>& faults)
      : p_(program), parameters_(parameters), faults_(faults) {}

  void run() {
    if (!pair_brackets()) return;
    find_functions();
    find_arrays();
    for (size_t i = 0; i < p_.tokens.size(); ++i)
      if (p_.tokens[i].kind == Token::Kind::word) p_.roles[i] = role_of(i);
    find_stored_swizzles();
    find_loops({0, p_.tokens.size()}, 1);
    check_globals();
    check_entry();
  }

 private:
  using Kind = Token::Kind;
  using Range = Program::Range;

  bool is(size_t i, std::string_view what) const { return i < p_.tokens.size() && p_.tokens[i].is(what); }
  bool is_word(size_t i) const { return i < p_.tokens.size() && p_.tokens[i].kind == Kind::word; }
  bool type_at(size_t i) const { return is_word(i) && is_type(p_.tokens[i].text); }
  const std::string& text(size_t i) const { return p_.tokens[i].text; }
  void fail(size_t i, std::string message) {
    faults_.push_back({p_.tokens[i].line, p_.tokens[i].column, std::move(message)});
  }

  bool pair_brackets();
  void find_functions();
  void read_parameters(const std::string& name, Range range);
  void find_arrays();
  Program::Role role_of(size_t i);
  void find_stored_swizzles();
  void find_loops(Range range, double turns);
  std::optional<double> known_turns(Range header, Range body) const;
  void check_globals();
  void check_entry();

  Program& p_;
  std::span<const std::string> parameters_;
  std::vector<Fault>& faults_;
  std::set<std::string, std::less<>> own_;      // functions of the text
  std::set<std::string, std::less<>> storing_;  // those with parameters that they write to
};

bool Analysis::pair_brackets() {
  std::vector<size_t> open;
  for (size_t i = 0; i < p_.tokens.size(); ++i) {
    if (p_.tokens[i].kind != Kind::sign) continue;
    const char c = text(i)[0];
    if (c == '(' || c == '[' || c == '{') open.push_back(i);
    if (c != ')' && c != ']' && c != '}') continue;
    const char wanted = c == ')' ? '(' : c == ']' ? '[' : '{';
    if (open.empty() || text(open.back())[0] != wanted) {
      fail(i, fmt::format("this '{}' closes nothing", c));
      return false;
    }
    p_.partner[i] = open.back();
    p_.partner[open.back()] = i;
    open.pop_back();
  }
  if (!open.empty()) fail(open.back(), fmt::format("this '{}' is never closed", text(open.back())));
  return open.empty();
}

// TYPE NAME ( … ) at the top level.
void Analysis::find_functions() {
  for (size_t i = 0; i < p_.tokens.size(); ++i) {
    if (is(i, "{") || is(i, "(") || is(i, "[")) {
      i = p_.partner[i];
      continue;
    }
    if (!type_at(i) || !is_word(i + 1) || !is(i + 2, "(")) continue;
    const size_t close = p_.partner[i + 2];
    Range body{close + 1, close + 1};
    if (is(close + 1, "{")) body.end = p_.partner[close + 1] + 1;
    p_.functions.push_back({text(i), text(i + 1), body});
    own_.insert(text(i + 1));
    read_parameters(text(i + 1), {i + 3, close});
    i = close;
  }
}

void Analysis::read_parameters(const std::string& name, Range range) {
  for (size_t i = range.begin; i < range.end; ++i) {
    if (!is(i, "in") && !is(i, "out") && !is(i, "inout")) continue;
    p_.directions.insert(i);
    if (is(i, "in")) continue;
    storing_.insert(name);
    if (type_at(i + 1)) p_.reference_types.insert(i + 1);
  }
}

// TYPE NAME [ SIZE ], and float[2](1, 2).
void Analysis::find_arrays() {
  std::map<std::string, size_t, std::less<>> arrays;
  std::set<size_t> declared;
  for (size_t i = 0; i + 1 < p_.tokens.size(); ++i) {
    if (!type_at(i)) continue;
    if (is(i + 1, "[")) {
      const size_t close = p_.partner[i + 1];
      if (is(close + 1, "("))
        p_.lists.push_back({i, close + 1});
      else
        fail(i, fmt::format("write the size of an array behind its name: {} name[…]", text(i)));
      i = close;
      continue;
    }
    if (!is_word(i + 1) || !is(i + 2, "[")) continue;
    size_t size = 0;
    const std::string& number = is(i + 3, "]") ? text(i + 1) : text(i + 3);
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), size);
    if (!is(i + 4, "]") || error != std::errc() || *end != '\0' || size < 1 || size > most_elements) {
      fail(i + 1,
           fmt::format("the size of an array must be a number from 1 to {}, written out", most_elements));
      continue;
    }
    if (is(i + 5, "[")) fail(i + 5, "arrays of arrays are not known here");
    const auto [entry, fresh] = arrays.emplace(text(i + 1), size);
    if (!fresh && entry->second != size)
      fail(i + 1, fmt::format("two arrays of different sizes are named '{}': rename one", text(i + 1)));
    p_.sizes.insert(i + 3);
    declared.insert(i + 2);
  }
  for (size_t i = 1; i < p_.tokens.size(); ++i) {
    const auto array = is(i, "[") && is_word(i - 1) ? arrays.find(text(i - 1)) : arrays.end();
    if (array != arrays.end() && !declared.contains(i))
      p_.indices.push_back({{i, p_.partner[i]}, array->second});
  }
}

Program::Role Analysis::role_of(size_t i) {
  using Role = Program::Role;
  const std::string& word = text(i);
  const bool called = is(i + 1, "(");
  if (i > 0 && is(i - 1, ".")) {
    if (!is_swizzle(word)) fail(i, fmt::format("'.{}' is no part of a vector", word));
    return Role::swizzle;
  }
  if (is_type(word)) return Role::type;
  if (is_keyword(word)) {
    if (word == "const")
      for (size_t next = i + 1; next < i + 3; ++next)
        if (is_word(next) && is_float_type(text(next))) p_.float_constants.insert(i);
    if ((word == "in" || word == "out" || word == "inout") && !p_.directions.contains(i))
      fail(i, fmt::format("'{}' stands before parameters of functions alone", word));
    return Role::other;
  }
  if (is_refused(word)) {
    fail(i, fmt::format("'{}' cannot be used in a formula", word));
    return Role::other;
  }
  if (word.starts_with("gl_")) fail(i, fmt::format("'{}' is not known here", word));
  if (!called || own_.contains(word)) return Role::name;
  if (is_built_in(word)) return Role::built_in;
  std::vector<std::string_view> known(built_in_functions().begin(), built_in_functions().end());
  known.insert(known.end(), own_.begin(), own_.end());
  const std::string nearest = nearest_name(word, known);
  fail(i, fmt::format("there is no function '{}' here{}", word,
                      nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest)));
  return Role::other;
}

// v.xy = …, v.xy += …, and v.xy as an argument of a function that may write to it.
void Analysis::find_stored_swizzles() {
  for (size_t i = 0; i < p_.tokens.size(); ++i) {
    if (p_.roles[i] != Program::Role::swizzle || text(i).size() < 2) continue;
    for (const std::string_view sign : {"=", "+=", "-=", "*=", "/=", "++", "--"})
      if (is(i + 1, sign)) p_.stored_swizzles.insert(i);
  }
  for (size_t i = 0; i + 1 < p_.tokens.size(); ++i) {
    if (!is_word(i) || !storing_.contains(text(i)) || !is(i + 1, "(")) continue;
    for (size_t k = i + 2; k < p_.partner[i + 1]; ++k)
      if (p_.roles[k] == Program::Role::swizzle && text(k).size() > 1 && k >= i + 4 &&
          (is(k - 3, "(") || is(k - 3, ",")) && (is(k + 1, ",") || is(k + 1, ")")))
        p_.stored_swizzles.insert(k);
  }
}

// How often for (int NAME = A; NAME < B; NAME++) goes round, where that can be read off: A and B written out,
// NAME left alone by the body, and no function called there that has loops of its own.
std::optional<double> Analysis::known_turns(Range header, Range body) const {
  const size_t at = header.begin;
  const auto number = [&](size_t i) -> std::optional<double> {
    if (i >= header.end || p_.tokens[i].kind != Kind::integer) return std::nullopt;
    double value = 0;
    const std::string& digits = text(i);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || *end != '\0') return std::nullopt;
    return value;
  };
  if (!(is(at, "int") && is_word(at + 1) && is(at + 2, "=") && is(at + 4, ";"))) return std::nullopt;
  const std::string& name = text(at + 1);
  const auto from = number(at + 3), to = number(at + 7);
  if (!from || !to || !is(at + 5, name) || !(is(at + 6, "<") || is(at + 6, "<=")) || !is(at + 8, ";"))
    return std::nullopt;
  const bool steps = (is(at + 9, name) && is(at + 10, "++")) || (is(at + 9, "++") && is(at + 10, name));
  if (!steps || header.end != at + 11) return std::nullopt;
  for (size_t i = body.begin; i < body.end; ++i) {
    if (is(i, "(") && i > 0 && is_word(i - 1) && own_.contains(text(i - 1))) return std::nullopt;
    if (!is(i, name)) continue;
    for (const std::string_view sign : {"=", "+=", "-=", "*=", "/=", "++", "--"})
      if (is(i + 1, sign)) return std::nullopt;
    if (i > 0 && (is(i - 1, "++") || is(i - 1, "--"))) return std::nullopt;
  }
  return std::max(0.0, *to - *from + (is(at + 6, "<=") ? 1 : 0));
}

// `turns`: how often what is here is done by loops that are not counted.
void Analysis::find_loops(Range range, double turns) {
  for (size_t i = range.begin; i < range.end; ++i) {
    const bool is_for = is(i, "for");
    if ((!is_for && !is(i, "while")) || !is(i + 1, "(")) continue;
    const Range header{i + 2, p_.partner[i + 1]};
    Range condition = header;
    if (is_for) {
      std::vector<size_t> ends;
      for (size_t k = header.begin; k < header.end; ++k) {
        if (is(k, ";")) ends.push_back(k);
        if (is(k, "(") || is(k, "[")) k = p_.partner[k];
      }
      if (ends.size() != 2) {
        fail(i, "a `for` needs three parts: for (int i = 0; i < 8; i++)");
        return;
      }
      condition = {ends[0] + 1, ends[1]};
    }
    if (type_at(condition.begin) && is_word(condition.begin + 1))
      fail(condition.begin, "declare that variable before the loop");

    // The statement after it; one in braces, or up to its semicolon (which may be inside of another loop).
    Range body{header.end + 1, header.end + 1};
    if (is(body.begin, "{")) {
      body.end = p_.partner[body.begin] + 1;
    } else {
      while (body.end < range.end && !is(body.end, ";") && !is(body.end, "{"))
        body.end = (is(body.end, "(") ? p_.partner[body.end] : body.end) + 1;
      if (is(body.end, "{")) body.end = p_.partner[body.end] + 1;
    }
    const auto known = is_for ? known_turns(header, body) : std::nullopt;
    const bool few = known && turns * *known <= most_uncounted_turns;
    if (!few) p_.conditions.push_back(condition);
    find_loops(body, few ? turns * *known : most_uncounted_turns);
    i = std::max(i, body.end - 1);
  }
}

// What lies outside of functions and is no constant would make f depend on what it was asked before.
void Analysis::check_globals() {
  bool constant = false;
  for (size_t i = 0; i < p_.tokens.size(); ++i) {
    if (is(i, "const")) constant = true;
    if (is(i, ";") || is(i, "}")) constant = false;
    if (type_at(i) && is_word(i + 1) && !is(i + 2, "(") && !constant)
      fail(i + 1,
           fmt::format("'{}' must be const: outside of functions a formula has no variables", text(i + 1)));
    if (is(i, "{") || is(i, "(") || is(i, "[")) i = p_.partner[i];
  }
}

void Analysis::check_entry() {
  const auto entry = [](const Program::Function& f) {
    return f.name == "f" && f.type == "float" && f.body.begin < f.body.end;
  };
  if (std::ranges::none_of(p_.functions, entry))
    faults_.push_back({1, 1, "the text must have a function `float f(vec3 p)`"});
}

}  // namespace

Program analyse(std::string_view text, std::span<const std::string> parameters, std::vector<Fault>& faults) {
  Program program;
  program.tokens = tokenize(text, faults);
  program.roles.resize(program.tokens.size(), Program::Role::other);
  program.partner.resize(program.tokens.size(), Program::none);
  Analysis(program, parameters, faults).run();
  return program;
}

}  // namespace eyeray::formula
