// Gate D: random paths agree with the reference sample by sample, or the reference explains why not.
#pragma once

#include "host/compare/against_reference.hpp"

namespace eyeray::engine::compare {

// Compares the samples of both frames. A sample whose path decides as the reference's does must have the
// reference's colour and counts, or ones within the neighbourhood's. A sample whose path diverges must
// diverge where some path of the reference's neighbourhood does. `outcomes`: the worst outcome of each
// pixel's samples is merged into it.
Tally compare_paths(const Frame& value, const Frame& reference, const PathReference& paths,
                    const Tolerances& tolerances, std::vector<PixelOutcome>& outcomes);

}  // namespace eyeray::engine::compare
