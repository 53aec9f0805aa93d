// Checks of a scene's formulas before anything is rendered.
#pragma once

#include <vector>

#include "host/core/diagnostic.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::executors {

// InputError, at the position in the user's text, where a formula has no Lipschitz constant and cannot be
// bounded by affine forms. No device is needed.
void check_formulas(const Scene& scene);

// Warnings, at the shapes whose formula is steeper than its Lipschitz constant at sampled points. The points
// are always the same. Error (timed_out) if a formula does not end.
std::vector<Diagnostic> doubt_lipschitz_constants(const Scene& scene);

}  // namespace eyeray::engine::executors
