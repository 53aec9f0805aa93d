// Writes a formula's text for compilers.
#include <fmt/format.h>

#include <set>

#include "host/formula/text.hpp"

namespace eyeray::engine::formula {

namespace {

// The text of all tokens: each as `spell` returns it, on the line that it has in the user's text.
template <typename Spell>
std::string line_by_line(const std::vector<Token>& tokens, const Spell& spell) {
  std::string result;
  int line = 1;
  for (size_t i = 0; i < tokens.size(); ++i) {
    result += tokens[i].line == line ? " " : "";
    for (; line < tokens[i].line; ++line) result += '\n';
    result += spell(i);
  }
  return result + '\n';
}

bool is_literal(const Token& token) {
  return token.kind == Token::Kind::integer || token.kind == Token::Kind::decimal || token.is("true") ||
         token.is("false");
}

// The initial value of an unset variable. User-defined names begin with user_prefix, so none is equal to it.
std::string zero_of(const Text::Unset& variable) {
  return variable.length == 0 ? fmt::format("{}(0)", variable.type)
                              : fmt::format("zero_{}_{}", variable.type, variable.length);
}

}  // namespace

std::string Text::glsl() const {
  return line_by_line(tokens, [&](size_t i) { return name_prefix(i) + tokens[i].text; });
}

std::vector<Text::Position> Text::positions() const {
  std::vector<Position> positions;
  int line = 0, column = 1;
  for (size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].line != line)
      column = tokens[i].line == 1 ? 2 : 1;
    else
      column += 1;
    line = tokens[i].line;
    positions.push_back({line, column, tokens[i].column});
    column += int(tokens[i].text.size() + name_prefix(i).size());
  }
  return positions;
}

std::string Text::unfolded(std::string& zeros) const {
  std::set<std::string> declared;
  for (const Unset& variable : unset)
    if (variable.length > 0 && declared.insert(zero_of(variable)).second)
      zeros += fmt::format("{} {}[{}];\n", variable.type, zero_of(variable), variable.length);

  size_t depth = 0;
  auto next_unset = unset.begin();
  return line_by_line(tokens, [&](size_t i) {
    const Token& token = tokens[i];
    if (token.is("(") || token.is("[") || token.is("{")) ++depth;
    if (token.is(")") || token.is("]") || token.is("}")) --depth;
    std::string result = name_prefix(i) + token.text;
    if (token.is("const") && depth == 0) result.clear();
    // (0, X) has the value X, but GLSL does not count it as a constant. A number alone in square brackets
    // stays, since it may be an array's size.
    if (is_literal(token) && !(tokens[i - 1].is("[") && tokens[i + 1].is("]")))
      result = fmt::format("(0, {})", token.text);
    for (; next_unset != unset.end() && next_unset->token == i; ++next_unset)
      result += next_unset->name.empty()
                    ? fmt::format(" = {}", zero_of(*next_unset))
                    : fmt::format(" {}{} = {};", user_prefix, next_unset->name, zero_of(*next_unset));
    return result;
  });
}

}  // namespace eyeray::engine::formula
