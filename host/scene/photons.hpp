// The settings by which photons are emitted and gathered (docs/photon-mapping.md): numbers that all executors
// share.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/scene/photon_targets.hpp"

namespace eyeray::engine {

struct PhotonSettings {
  uint32_t count;  // number of photons of each sample
  double radius;   // radius of the disk on which the first sample gathers photons
  // The centre of a sphere around all bounded objects. Lights that are infinitely far away emit their photons
  // towards it.
  Vec3 center;
  double reach;                            // the radius of that sphere
  std::vector<PhotonTarget> targets = {};  // at which photons are aimed
};

// The decisions of a photon, and sums over the points where it is stored.
struct PhotonWay {
  uint32_t trail = 0;  // fingerprint of its decisions, like PixelSample::trail
  Vec3 positions{0};
  Vec3 directions{0};
  Vec3 flux{0};
  Vec3 sent{0};  // the flux with which it starts; set by the reference only

  void add(const Vec3& position, const Vec3& direction, const Vec3& its_flux) {
    positions += position;
    directions += direction;
    flux += its_flux;
  }
};

// The photons that bring no light: for each sample their numbers, in order.
struct LeftOutPhotons {
  std::vector<std::vector<uint32_t>> by_sample = {};

  std::span<const uint32_t> of(uint32_t sample) const {
    if (sample >= by_sample.size()) return {};
    return by_sample[sample];
  }
  bool operator==(const LeftOutPhotons&) const = default;
};

// If the scene sets no radius, the radius is two pixels wide as seen at the middle of all bounded objects, or
// at the camera's target if there are none.
PhotonSettings photon_settings(const Scene& scene);

// The radius of sample `index`. As the radius shrinks, variance grows and bias falls; with this choice the
// mean of all samples converges (Knaus, Zwicker: Progressive Photon Mapping: A Probabilistic Approach, TOG
// 2011).
double photon_radius(const PhotonSettings& settings, uint32_t index);

}  // namespace eyeray::engine
