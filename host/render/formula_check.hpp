// What can be found wrong with the formulas of a scene before anything is rendered.
#pragma once

#include <vector>

#include "calculus/tape.hpp"
#include "core/diagnostic.hpp"
#include "scene/scene.hpp"

namespace eyeray {

// InputError, at the places in the users' texts, where a formula does not compile as GLSL, or has no
// Lipschitz constant and cannot be enclosed. No device is needed.
void compile_formulas(const Scene& scene);

// The function as what can be enclosed along rays. InputError, at the place in the user's text, where it
// cannot be written so.
calculus::StraightLine enclose_formula(const Formula& formula);

// Warnings, at the shapes, where samples say that a formula is steeper than its Lipschitz constant; always
// the same samples. None where there is no C++ compiler to take them with. Formulas must have been found to
// compile. Error (timed_out) where one does not end.
std::vector<Diagnostic> doubt_lipschitz_constants(const Scene& scene);

}  // namespace eyeray
