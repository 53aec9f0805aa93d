// Photons of float32 beside the reference's: gate D, before any is gathered.
#pragma once

#include "host/compare/report.hpp"
#include "host/executors/executor.hpp"
#include "host/reference/renderer.hpp"

namespace eyeray::verify {

// How far from the reference's a photon may lie and be shown, as a share of the radius: of its light a kernel
// tells twice that.
inline constexpr double photon_aside = 1e-3;

struct JudgedPhotons {
  std::vector<std::vector<uint32_t>> left_out;  // by sample, in order: those that no picture may show
  compare::PhotonTally tally;
};

// Those of all samples of the scene that go another way than the reference's, or the same way to other
// places: each lights a disk of pixels. The reference must know of each, by photons of its own that are
// rounded as float32 may round them. `renderer` and both executors are those of `scene`.
JudgedPhotons judge_photons(const Scene& scene, executors::Executor& twin,
                            executors::Executor& reference_executor, const reference::Renderer& renderer);

}  // namespace eyeray::verify
