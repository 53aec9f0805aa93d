// Chooses the kernels that trace a scene's rays on a device: coherent rays, incoherent rays, and those of a
// picture.
#pragma once

#include "host/executors/profile.hpp"
#include "host/records/packer.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::executors {

struct TracePlan {
  Rays coherent = Rays::lanes;  // or packets
  Rays incoherent = Rays::lanes;
  bool wavefront = false;      // whether pictures use a wavefront, which traces camera rays in packets
  Rays bounced = Rays::lanes;  // later bounces of a wavefront
};

// `requested`: the user's choices, which hold wherever the scene allows them. `subgroup_size`: in lanes.
TracePlan plan_tracing(const Profile& profile, const ProfileOptions& requested, const ImageSettings& image,
                       const records::PackedScene& scene, uint32_t subgroup_size);

// True if a CPU makes the picture sooner with vectors of 512 bits, each ray alone on its lane. The picture
// then has enough samples to repay compiling for such vectors, and packets in vectors of 256 bits are not
// faster. The answer is known before a device is open, since its driver needs it (gpu/vector_width.hpp).
bool wants_wide_vectors(const ProfileOptions& requested, const ImageSettings& image,
                        const records::PackedScene& scene);

}  // namespace eyeray::engine::executors
