// Gate D for photons, before any is gathered: compares those of float32 with the reference's.
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

// Finds, in all samples of the scene, the photons that take another path than the reference's, or the same
// path to other points. Each lights a disk of pixels. The reference must explain each by its own photons,
// rounded as float32 may round them. `renderer`: that of the scene. `ways(index)`: the twin's photons of a
// sample.
JudgedPhotons judge_photons(const Scene& scene,
                            const std::function<std::vector<PhotonWay>(uint32_t index)>& ways,
                            const reference::Renderer& renderer);

}  // namespace eyeray::engine::verify
