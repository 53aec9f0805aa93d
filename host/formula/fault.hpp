// An error in a formula's text.
#pragma once

#include <string>

namespace eyeray::engine::formula {

struct Fault {
  int line;    // line of the text, from 1
  int column;  // from 1; 0 where unknown
  std::string message;
};

}  // namespace eyeray::engine::formula
