// Known answers, computed by a device before it renders: some drivers compute wrong results, and return
// VK_SUCCESS.
#pragma once

#include <cstdint>

#include "host/core/disk_cache.hpp"
#include "host/gpu/device.hpp"
#include "host/gpu/shader_source.hpp"
#include "host/gpu/worst_device.hpp"

namespace eyeray::engine::gpu {

// Measured facts about a device's arithmetic.
struct DeviceFacts {
  uint32_t loop_iterations = 0;  // iterations made, of 100 000 requested
  bool loop_cap = false;  // the driver ends loops early, with no error (Mesa 22.3: after 65 535 iterations)
  bool denormals_kept = false;    // no operand and no result of + − × and comparisons is flushed to zero
  bool infinities_kept = false;   // + − × ÷ of infinities, and 1 / 0, are those of IEEE 754
  bool exact_division = false;    // the device's own ÷ and √ round as IEEE 754 has it
  bool exact_arithmetic = false;  // + − × round so too, ÷ and √ at least if corrected, a·b + c rounds twice,
                                  // and denormals, zeros of both signs, infinities and NaN are kept
  double seconds = 0;             // the duration of the self-test
};

// Runs "kernels/selftest.comp.glsl" of `shaders`. Error (no_device) when integers, indices or the bits of a
// float come out wrong. `worst`: KernelOptions::worst.
DeviceFacts self_test(Device& device, const SourceProvider& shaders, const DiskCache& cache,
                      const WorstDevice& worst = {});

// The facts that a GPU is expected to have, for one that is not there to be tested.
DeviceFacts expected_of_gpus();

}  // namespace eyeray::engine::gpu
