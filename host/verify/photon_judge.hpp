// Photons of float32 beside the reference's: gate D, before any is gathered.
#pragma once

#include <functional>

#include "host/compare/report.hpp"
#include "host/reference/renderer.hpp"
#include "host/scene/photons.hpp"

namespace eyeray::engine::verify {

struct JudgedPhotons {
  LeftOutPhotons left_out;  // those that no picture may show
  compare::PhotonTally tally;
};

// The photons of all samples of the scene that take another path than the reference's, or the same path to
// other points: each lights a disk of pixels. The reference must explain each, by photons of its own rounded
// as float32 may round them. `renderer` is the scene's, and `ways(index)` are the twin's photons of a sample.
JudgedPhotons judge_photons(const Scene& scene,
                            const std::function<std::vector<PhotonWay>(uint32_t index)>& ways,
                            const reference::Renderer& renderer);

}  // namespace eyeray::engine::verify
