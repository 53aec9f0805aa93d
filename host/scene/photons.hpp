// The settings by which photons are emitted and gathered (docs/photon-mapping.md): numbers that all executors
// share.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/scene/photon_targets.hpp"

namespace eyeray::engine {

struct PhotonSettings {
  uint32_t count;  // of each sample
  double radius;   // of the disk on which the first sample gathers them
  Vec3 center;     // of a sphere around all that has an end, which lights from afar send their photons to
  double reach;    // and its radius
  std::vector<PhotonTarget> targets = {};  // that photons are aimed at
};

// The decisions of a photon, and the points where it is stored.
struct PhotonWay {
  uint32_t trail = 0;  // fingerprint of its decisions, like PixelSample::trail
  Vec3 places{0};      // the sum of those where it stays
};

// Photons that bring no light: by sample their numbers, in order.
struct LeftOutPhotons {
  std::vector<std::vector<uint32_t>> by_sample = {};

  std::span<const uint32_t> of(uint32_t sample) const {
    if (sample >= by_sample.size()) return {};
    return by_sample[sample];
  }
};

// If the scene sets no radius, the radius is two pixels wide as seen at the middle of all bounded objects, or
// at the camera's target if there are none.
PhotonSettings photon_settings(const Scene& scene);

// The radius of sample `index`. Variance grows as it shrinks, and bias falls; by this choice the mean of all
// samples converges (Knaus, Zwicker: Progressive Photon Mapping: A Probabilistic Approach, TOG 2011).
double photon_radius(const PhotonSettings& settings, uint32_t index);

}  // namespace eyeray::engine
