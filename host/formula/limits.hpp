// The size of a formula with all functions that it calls, and a limit on its running time. Private to this
// layer.
#pragma once

#include <string>

#include "host/formula/ir.hpp"

namespace eyeray::engine::formula {

// The size of a function, with each call replaced by the called function.
struct Size {
  double instructions = 0;
  double branches = 0;  // branches and loops
  double memory = 0;    // numbers in arrays
  // Instructions of one call, with one iteration of each counted loop. docs/security.md lists the limits.
  double work = 0;
};

// Decides for each loop whether its iterations are counted, and their weight. Returns the message for the
// first limit that is exceeded; "" if none is.
std::string limit(ir::Program& program);
// The instructions and branches of `value` and `other` together, after limit(). Memory and work are those of
// `value` alone.
Size size_of(const ir::Program& program);

}  // namespace eyeray::engine::formula
