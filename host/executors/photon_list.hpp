// Photons in the order in which paths gather them. The order does not depend on the executor that traced
// them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/records/records.hpp"
#include "host/scene/photons.hpp"

namespace eyeray::engine::executors {

struct PhotonList {
  std::vector<shader::Photon> photons;  // sorted by key, then by number, then by depth
  std::vector<uint32_t> cells;  // the index at which each key's photons begin, and the end of the last key's
};

// Makes the list of the photons `stored`, which are in any order. `left_out` is sorted: photons whose number
// it contains contribute nothing.
PhotonList photon_list(std::span<const shader::Photon> stored, uint32_t key_mask,
                       std::span<const uint32_t> left_out);

// The record of sample `index` for the shaders, whose origin is the eye. `capacity`: the photons that fit
// into the buffer.
shader::PhotonPass photon_pass(const PhotonSettings& settings, uint32_t index, const Vec3& eye,
                               uint32_t capacity);

}  // namespace eyeray::engine::executors
