// The words, numbers and signs of a formula's text. Private to this layer.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/formula/fault.hpp"

namespace eyeray::engine::formula {

struct Token {
  enum class Kind { word, integer, decimal, sign };
  Kind kind;
  std::string text;  // for a sign one to three characters: +, +=, <<=
  int line;          // from 1
  int column;        // from 1, in bytes

  bool is(std::string_view what) const { return text == what; }
};

// Splits a text into tokens, without comments. A character that begins no token is a fault; the
// preprocessor's # is one as well.
std::vector<Token> tokenize(std::string_view text, std::vector<Fault>& faults);

}  // namespace eyeray::engine::formula
