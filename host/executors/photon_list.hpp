// Photons in the order in which paths gather them: the same whoever has traced them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/records/records.hpp"
#include "host/scene/photons.hpp"

namespace eyeray::engine::executors {

struct PhotonList {
  std::vector<shader::Photon> photons;  // by key; of the same key by number, then by depth
  std::vector<uint32_t> cells;          // where each key's begin, and where the last one's end
};

// Makes the list of the photons `stored`, which are in any order. Photons whose number is in `left_out`,
// which is sorted, contribute nothing.
PhotonList photon_list(std::span<const shader::Photon> stored, uint32_t key_mask,
                       std::span<const uint32_t> left_out);

// For the shaders, whose origin is the eye: of sample `index`, with room for so many photons.
shader::PhotonPass photon_pass(const PhotonSettings& settings, uint32_t index, const Vec3& eye,
                               uint32_t capacity);

}  // namespace eyeray::engine::executors
