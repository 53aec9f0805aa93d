// The text of a formula before any compiler sees it: its tokens, judged by their words, number and
// nesting. Private to this layer.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host/formula/entry.hpp"
#include "host/formula/fault.hpp"
#include "host/formula/token.hpp"

namespace eyeray::engine::formula {

// Prefix of user-defined names in the text for the compiler, so that none is one of GLSL's names.
inline constexpr std::string_view user_prefix = "user_";

struct Text {
  std::vector<Token> tokens;
  std::vector<bool> is_name;               // for each token: whether it is a user-defined name
  bool has_other = false;                  // whether the text defines other_entry_of() its kind
  std::optional<size_t> uncalled_other{};  // the token of that function's name, if the text never calls it

  // A variable without an initial value: one that is declared without it, or an `out` parameter.
  struct Unset {
    size_t token;      // the initial value is to be written behind this token
    std::string type;  // type of the variable, or of an array's elements
    size_t length;     // length of an array, else 0
    std::string name;  // name of a parameter, else empty
  };
  std::vector<Unset> unset{};  // in the order of their tokens

  // The line and column of a token in glsl(), and its column in the user's text; all from 1.
  struct Position {
    int line, column;
    int source_column;
  };
  // The text for a compiler: the tokens alone, each on the line that it has in the user's text, with
  // user_prefix before each user-defined name. Comments, line continuations and everything else that two
  // readers might read differently are gone.
  std::string glsl() const;
  std::vector<Position> positions() const;
  // The same program on the same lines, in a form in which a compiler folds nothing. Its constants are global
  // variables, and every variable without an initial value gets 0. The text of glsl() must have passed a
  // compiler. The declarations that must precede the program are added to `zeros`.
  std::string unfolded(std::string& zeros) const;

 private:
  std::string name_prefix(size_t token) const {
    return is_name[token] ? std::string(user_prefix) : std::string();
  }
};

// Adds the text's faults to `faults`, each at its position. A text without faults may go to a compiler. It
// has at most 64 KiB, nests at most 64 deep, chains at most 500 operators, has only words that formulas know,
// and defines the function that its kind requires.
Text read_text(std::string_view text, FormulaKind kind, std::vector<Fault>& faults);

}  // namespace eyeray::engine::formula
