// Rewrites a finished kernel so that a device that keeps more than Vulkan promises computes it as one that
// keeps no more: for tests of the float policy, the self-test and the shaders.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace eyeray::engine::gpu {

// The freedoms that Vulkan leaves to a device and that the simulated device takes.
struct WorstDevice {
  bool division = false;  // quotients and roots are off by up to 2 units in the last place (math/worst.glsl)
  bool contraction = false;  // a·b + c rounds once, unless NoContraction forbids it; fma does so too
  bool denormals = false;    // operands and results are flushed to zero, unless DenormPreserve forbids it
  bool nan = false;  // min, max and clamp return either operand if they have a NaN, or zeros of both signs

  bool operator==(const WorstDevice&) const = default;
};

// The module `spirv`, which the device would get, with every freedom of `worst` except `division`, which
// KernelOptions takes before the optimiser. The device needs Float64 for `contraction`.
std::vector<uint32_t> on_worst_device(std::span<const uint32_t> spirv, const WorstDevice& worst);

}  // namespace eyeray::engine::gpu
