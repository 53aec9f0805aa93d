// The text of a formula before any compiler sees it: its tokens, judged by their words, number and
// nesting. Private to this layer.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/formula/entry.hpp"
#include "host/formula/fault.hpp"
#include "host/formula/token.hpp"

namespace eyeray::engine::formula {

// Before every name of a user's in the compiler's text, so that none is one of GLSL's.
inline constexpr std::string_view user_prefix = "user_";

struct Text {
  std::vector<Token> tokens;
  std::vector<bool> is_name;  // of the text's own, for each token
  bool has_other = false;     // whether it defines other_entry_of() its kind

  // A variable that the text gives no value where it begins: declared without one, or an `out` parameter.
  struct Unset {
    size_t token;      // its value is to be written behind this one
    std::string type;  // of an element, if it is an array
    size_t length;     // of an array, else 0
    std::string name;  // of a parameter, else empty
  };
  std::vector<Unset> unset{};  // in the order of their tokens

  // The position of a token of glsl() in the text; both numbers from 1.
  struct Place {
    int line, column;
    int source_column;
  };
  // The text for a compiler: the tokens alone, each on its own line of the text, with user_prefix before each
  // name. Comments, line continuations and everything else that two readers might read differently are gone.
  std::string glsl() const;
  std::vector<Place> places() const;
  // The same program, line by line, in a form that a compiler folds nothing of: its constants are global
  // variables, and every variable is initialised explicitly to 0. glsl() must have passed a compiler.
  // `zeros`: declarations that must precede it.
  std::string unfolded(std::string& zeros) const;

 private:
  std::string name_prefix(size_t token) const {
    return is_name[token] ? std::string(user_prefix) : std::string();
  }
};

// Adds the text's faults to `faults`, each at its position. Without faults a compiler may see it. It then has
// at most 64 KiB, nests at most 64 deep, chains at most 500 operators, has only words that formulas know, and
// defines the functions that its kind must.
Text read_text(std::string_view text, FormulaKind kind, std::vector<Fault>& faults);

}  // namespace eyeray::engine::formula
