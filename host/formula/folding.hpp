// Computes a formula's constants beforehand, as the interpreter would. Private to this layer.
#pragma once

#include "host/formula/module.hpp"

namespace eyeray::engine::formula {

// Finds the variables, global ones too, of which every read gives the same constant. Replaces each
// instruction that computes from constants alone by its result, in float32 by the functions of the
// interpreter. The module must come from a text that Text::unfolded() spelled. There each variable is stored
// to at its declaration, so a variable that is stored to once has the same value at every read.
void fold(Module& module);

}  // namespace eyeray::engine::formula
