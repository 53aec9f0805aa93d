// How kernels are made for a device: none of it changes a hit, all of it how fast hits are found
// (docs/performance.md).
#pragma once

#include <optional>
#include <string>

#include "gpu/device.hpp"
#include "records/packer.hpp"
#include "render/options.hpp"

namespace eyeray {

// How rays are traced: each alone on its lane (query.comp.glsl), many together (packet.comp.glsl), or each by
// four lanes (wide.comp.glsl).
enum class Rays { lanes, packets, wide };

struct Profile {
  bool texel_buffers = false;  // load the scene as texels of 16 bytes instead of from storage buffers
  bool packets = false;        // trace rays that run side by side together
  bool shift_stack =
      false;              // keep the stack in registers, shifted as a whole, instead of in an indexed array
  bool constants = true;  // compile a small scene in, instead of loading it
  // Rays that part, where the scene allows it; by the scene it is wide in big trees, lanes in small ones.
  std::optional<Rays> scattered = Rays::lanes;
  bool flatten = false;  // compute both sides of a branch that only chooses a value
};

// Error (bad_input) for an unknown choice.
Profile choose_profile(const ProfileOptions& options, const gpu::DeviceInfo& device);

// How rays that part are traced in this scene, where `packets` says whether any can be traced together.
Rays scattered_rays(const Profile& profile, const PackedScene& scene, bool packets, uint32_t subgroup_size);

// For people: "texel loads, packets, shifted stack, scattered rays by the scene", and "no constants" and
// "flattened" where that is so.
std::string describe(const Profile& profile);

}  // namespace eyeray
