// By which kernels a scene's rays are traced on a device: coherent and incoherent ones, and a picture's.
#pragma once

#include "host/executors/profile.hpp"
#include "host/records/packer.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::executors {

struct TracePlan {
  Rays coherent = Rays::lanes;  // or packets
  Rays incoherent = Rays::lanes;
  bool wavefront = false;      // whether pictures take the wavefront, whose eye rays go in packets
  Rays bounced = Rays::lanes;  // later bounces of a wavefront
};

// `asked`: what people chose themselves, which is done wherever the scene allows it. `subgroup_size`: lanes.
TracePlan plan_tracing(const Profile& profile, const ProfileOptions& asked, const ImageSettings& image,
                       const records::PackedScene& scene, uint32_t subgroup_size);

}  // namespace eyeray::executors
