// Constants of a formula, computed as everything else is. Private to this layer.
#pragma once

#include "host/formula/module.hpp"

namespace eyeray::engine::formula {

// Finds the variables that are only ever seen as one constant, those outside of functions among them. It
// replaces each instruction that computes from constants alone by its result, in float32 by the functions of
// the interpreter. The module must be of a text as Text::unfolded() spells it, in which each variable is
// stored to where it begins: one that is stored to once is never seen otherwise.
void fold(Module& module);

}  // namespace eyeray::engine::formula
