// Gate D: random paths agree with the reference sample by sample, or the reference explains why not.
#pragma once

#include "host/compare/against_reference.hpp"

namespace eyeray::engine::compare {

// Compares the samples of both frames. A sample whose path takes the reference's decisions must have the
// reference's counts, and a colour that matches the reference's or lies within the neighbourhood's bounds. A
// sample whose path diverges must diverge where some path of the reference's neighbourhood does. `outcomes`:
// the worst outcome of each pixel's samples is merged into it.
Tally compare_paths(const Frame& value, const Frame& reference, const PathReference& paths,
                    const Tolerances& tolerances, std::vector<PixelOutcome>& outcomes);

}  // namespace eyeray::engine::compare
