// Gate D: random paths agree with the reference sample by sample, or the reference explains why not.
#pragma once

#include "host/compare/against_reference.hpp"

namespace eyeray::engine::compare {

// How the samples of both frames came out. A sample whose path decides what the reference's does must have
// its colour, and its counts, or one within the neighbourhood's; one whose path parts must do where some path
// of the reference's neighbourhood does. `outcomes`: of every pixel the worst of its samples is added to what
// is there.
Tally compare_paths(const Frame& value, const Frame& reference, const PathReference& paths,
                    const Tolerances& tolerances, std::vector<PixelOutcome>& outcomes);

}  // namespace eyeray::engine::compare
