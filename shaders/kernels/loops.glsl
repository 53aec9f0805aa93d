// Drivers that end loops early without any report (docs/lavapipe.md).
#ifndef LOOPS_GLSL
#define LOOPS_GLSL
#include "records.h"

SHADER_BEGIN

// FLAG_LOOP_BUDGET if the driver has ended any loop of this invocation before its time, queried at the invocation's end: once it has,
// no loop runs a second iteration. `two` comes from a buffer, so that no compiler knows how this one ends. Checking the value that a
// loop was to reach does not help: compilers take it as reached. FLAG_ENDLESS where a formula's loops were ended by
// math/formula.glsl's own count.
// FLAG_ENDLESS_LOOP where the driver ended a loop, or executors/loop_guard.hpp did, in a kernel that may hold a user's shaders.
uint loops_cut_off(uint two) {
  uint rounds = 0u;
  while (rounds < two) rounds += 1u;
  uint flags = rounds != two ? FLAG_LOOP_BUDGET : 0u;
#ifdef FORMULA_OVERRAN
  flags = flags | (FORMULA_OVERRAN ? FLAG_ENDLESS : 0u);
#endif
#ifdef STOPPED_LOOPS
  if (rounds != two || STOPPED_LOOPS != 0u) flags = flags | FLAG_ENDLESS_LOOP;
#if !RAY_KINDS
  flags = flags | STOPPED_LOOPS;
#endif
#endif
  return flags;
}

SHADER_END
#endif
