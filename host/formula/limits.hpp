// The size of a formula with all functions that it calls, and a limit on its running time. Private to this
// layer.
#pragma once

#include <string>

#include "host/formula/ir.hpp"

namespace eyeray::engine::formula {

// A function with the functions that it calls written in place of the calls.
struct Size {
  double instructions = 0;
  double branches = 0;  // and loops
  double memory = 0;    // numbers in arrays
  // Instructions of one call, with one iteration of each counted loop. docs/security.md lists the limits.
  double work = 0;
};

// Decides for each loop whether its iterations are counted, and their weight. Returns the exceeded limit, in
// words; "" if there is none.
std::string limit(ir::Program& program);
// The size of both functions together, after limit().
Size size_of(const ir::Program& program);

}  // namespace eyeray::engine::formula
