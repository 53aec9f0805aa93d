// The better one of two fits, pixel by pixel.
#pragma once

#include "host/denoise/planes.hpp"

namespace eyeray::engine::denoise {

// Writes to planes [begin, end) of `best` at each pixel the better one of itself and `other`. Each half of a
// fit is compared with the other half of the noisy `colors`, less that half's variance, in a small window.
// The better fit is then mixed with the noisy halves so that the error is least: for an error e² and the
// variance v of both halves' mean, by e²/(e² + v). The estimate of e² is uncertain by about v, which does not
// count. Pixels at which `valid` is 0 stay as they are.
void choose_best(const Halves& colors, const Halves& variances, const Planes& valid, int begin, int end,
                 const Halves& other, Halves& best);

}  // namespace eyeray::engine::denoise
