// The choices in making kernels for a device. They change no hit, only the speed of finding hits
// (docs/performance.md).
#pragma once

#include <optional>
#include <string>

#include "host/executors/profile_options.hpp"
#include "host/gpu/device.hpp"

namespace eyeray::engine::executors {

// The ways of tracing rays: each alone on its lane (kernels/query.comp.glsl), many together
// (kernels/cooperative/packet.comp.glsl), or each by four lanes (kernels/cooperative/bvh4.comp.glsl).
enum class Rays { lanes, packets, cooperative };

struct Profile {
  bool texel_buffers = false;  // load the scene as texels of 16 bytes instead of from storage buffers
  bool packets = false;        // trace coherent rays together
  bool shift_stack =
      false;              // keep the stack in registers, shifted as a whole, instead of in an indexed array
  bool constants = true;  // compile materials and lights in, instead of loading them
  bool unrolls = true;    // compile a small scene's primitives in, too
  // The way of tracing incoherent rays, where the scene allows it. No value: the scene decides, for
  // `cooperative` in big BVHs and for `lanes` in small ones.
  std::optional<Rays> incoherent = Rays::lanes;
  bool flatten = false;  // compute both sides of a branch that only chooses a value
};

Profile choose_profile(const ProfileOptions& options, const gpu::DeviceInfo& device);

// For people: "texel loads, packets, shifted stack, incoherent rays by the scene", followed by "no constants"
// and "flattened" if these hold.
std::string describe(const Profile& profile);

}  // namespace eyeray::engine::executors
