// How kernels are made for a device: none of it changes a hit, all of it how fast hits are found
// (docs/performance.md).
#pragma once

#include <string>

#include "gpu/device.hpp"
#include "render/options.hpp"

namespace eyeray {

struct Profile {
  bool texel_buffers = false;  // load the scene as texels of 16 bytes instead of from storage buffers
  bool packets = false;        // trace rays that run side by side together (packet.comp.glsl)
  bool shift_stack =
      false;  // keep the stack in registers, shifted as a whole, instead of in an indexed array
};

// Error (bad_input) for an unknown choice.
Profile choose_profile(const ProfileOptions& options, const gpu::DeviceInfo& device);

// For people: "texel loads, shifted stack".
std::string describe(const Profile& profile);

}  // namespace eyeray
