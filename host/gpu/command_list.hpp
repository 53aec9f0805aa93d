// Work for the device: dispatches in order, submitted and waited for as one.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "host/gpu/kernel.hpp"

namespace eyeray::engine::gpu {

// Work groups along each axis.
struct Groups {
  uint32_t x = 1;
  uint32_t y = 1;
  uint32_t z = 1;
};

struct RunTime {
  double seconds = 0;
  bool device_clock = false;   // whether the device's timestamps measured it; otherwise the host's clock,
                               // submission and wait included
  double compile_seconds = 0;  // before the run, for the driver to compile a kernel at its first dispatch
};

// A list of commands; a device has one list at a time.
class CommandList {
 public:
  explicit CommandList(Device& device);
  ~CommandList();
  CommandList(const CommandList&) = delete;
  CommandList& operator=(const CommandList&) = delete;

  // Error (bad_input) if the kernel declares push constants of another size, or a buffer that is not bound.
  // `groups` must be within the device's limits.
  void dispatch(const Kernel& kernel, std::span<const std::byte> push_constants, Groups groups);
  // Makes the writes of earlier dispatches visible to later ones.
  void barrier();
  // Submits the list, and waits until the device is done. Error (timed_out), (interrupted) or (no_device);
  // see Context::submit_and_wait.
  RunTime run();

 private:
  friend RunTime dispatch(Device&, const Kernel&, std::span<const std::byte>, Groups);
  RunTime run(double timeout_seconds);

  std::shared_ptr<Context> context_;
  std::string name_;  // name of the kernels, for errors
};

// Runs a list of one dispatch. Drivers put off compiling a kernel until its first dispatch (lavapipe: its
// machine code). So before its first run a kernel is dispatched without work groups, and no run takes longer
// than another.
RunTime dispatch(Device& device, const Kernel& kernel, std::span<const std::byte> push_constants,
                 Groups groups);

}  // namespace eyeray::engine::gpu
