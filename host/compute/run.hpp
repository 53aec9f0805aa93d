// Runs a job on a device, or by the emulator.
#pragma once

#include <string>
#include <vector>

#include "host/compute/job.hpp"
#include "host/gpu/device.hpp"

namespace eyeray::engine::emulator {
struct Trace;
}

namespace eyeray::engine::compute {

struct RunOptions {
  gpu::DeviceOptions device;
  bool fast_math = false;  // leave the kernel's arithmetic to the driver; else each operation rounds once
  emulator::Trace* trace = nullptr;  // traces one invocation; of the emulator alone
};

struct Outcome {
  std::string executor;                          // "gpu" or "emulator"
  std::string description;                       // "gpu: llvmpipe (LLVM 15.0.6, 256 bits)"
  std::vector<std::vector<std::byte>> buffers;   // after the run
  std::vector<emulator::Finding> findings;       // the emulator's
  std::vector<std::string> validation_messages;  // the validation layer's
  double seconds = 0;
};

// Dispatches the kernel once. Error (no_device) if the job exceeds a limit of the device, or if the kernel
// wrote outside of its buffers; the errors of gpu::Device and gpu::CommandList.
Outcome run(const Job& job, const RunOptions& options);

// Writes the buffers that have an output, whole or not at all each.
void write_outputs(const Job& job, const Outcome& outcome);

}  // namespace eyeray::engine::compute
