// A Vulkan device that can run compute shaders. This layer knows bytes, never rays. Its public headers do not
// include Vulkan's.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "host/emulator/finding.hpp"

namespace eyeray::engine::gpu {

enum class DeviceType { discrete, integrated, virtual_gpu, cpu, other };

struct DeviceLimits {
  uint64_t storage_range = 0;            // bytes of one buffer that a shader can see
  uint64_t texel_range = 0;              // bytes of one texel buffer that a shader can see, 16 a texel
  uint64_t uniform_range = 0;            // bytes of one uniform buffer that a shader can see
  uint64_t heap = 0;                     // bytes of the largest heap that buffers come from
  uint64_t allocation = 0;               // bytes of one allocation
  uint64_t offset_alignment = 0;         // bytes; the alignment of a buffer's start in its memory
  std::array<uint32_t, 3> groups{};      // work groups of one dispatch, along each axis
  std::array<uint32_t, 3> group_size{};  // invocations of one work group, along each axis
  uint32_t group_invocations = 0;        // invocations of one work group in all
  uint32_t shared_memory = 0;            // bytes of one work group
  uint32_t push_constants = 0;           // bytes
  uint32_t storage_buffers = 0;          // a kernel may have so many
  uint32_t texel_buffers = 0;            // a kernel may have so many
  uint32_t uniform_buffers = 0;          // a kernel may have so many
  uint32_t subgroup_size = 0;
  uint32_t drawn_size = 0;     // pixels of the longest side of a picture that the device can draw
  uint32_t subpixel_bits = 0;  // the device rounds the vertices that it draws to 2^−bits of a pixel
};

// Execution modes for float32 that a shader may ask for.
struct FloatModes {
  bool denorm_preserve = false;
  bool round_to_nearest_even = false;
  bool signed_zero_inf_nan_preserve = false;
};

struct DeviceInfo {
  int index = 0;  // the value for --device
  std::string name;
  std::string driver;          // "llvmpipe"
  std::string driver_version;  // "Mesa 22.3.6 (LLVM 15.0.6)"
  std::string api_version;     // "1.3.230"
  std::string driver_id;       // changes with anything that makes a compiled pipeline stale; hexadecimal
  DeviceType type = DeviceType::other;
  bool slow_compiler = false;  // branches in loops take it minutes and many gigabytes, if it ends at all
  bool compiles_only = false;  // null hardware: a driver that compiles kernels for a device that is not there
  bool usable = false;
  std::string why_not;  // reasons, when not usable
  DeviceLimits limits;
  FloatModes float_modes;
};

// Every device of every driver, in the order of their indices. Error (no_device), which names the packages to
// install, when there is no Vulkan loader, no driver or no device.
std::vector<DeviceInfo> list_devices();

struct DeviceOptions {
  std::string select = "auto";   // auto | cpu | gpu | INDEX | part of a NAME; see choose_device
  std::string validation = "";   // "", "core" or "sync": run under the Khronos validation layer
  double timeout_seconds = 60;   // the longest wait for one submission
  double compile_seconds = 60;   // the longest time that the driver may take to compile one kernel
  bool wide_vectors = false;     // see set_vector_width; a process's first device decides
  bool sets_environment = true;  // whether a process's first device may set the environment for its driver
  bool draws = false;            // open a queue that also suits Rasterizer, if there is one
  bool force_staging = false;    // tests: copy through staging buffers even where memory is shared
  // Compile each kernel anew, with the driver's statistics if it has any; null hardware suffices.
  bool examines_kernels = false;
  // Enable all features that a user's kernel may declare and the device has, such as numbers of 64 bits.
  bool all_features = false;
  // Run kernels by the emulator, as the chosen device would get them.
  bool emulate = false;
  bool emulated_descending = false;  // run work groups from the last to the first: emulator::Order
  uint32_t emulated_subgroup = 0;    // invocations of its subgroups; 0: as many as the device's have
};

struct Context;

// An instance, a device and one queue, destroyed when the last Buffer and Kernel made from it is gone. After
// a time-out, destroying the device would block. So it is left behind, and the process ends without tearing
// the driver down.
class Device {
 public:
  // Error (no_device) when no device suffices, (bad_input) for a bad option.
  explicit Device(const DeviceOptions& options);

  const DeviceInfo& info() const;
  // True if the processor and the device share memory, so that a buffer's bytes need no copying.
  bool shares_memory() const;
  // The warnings and errors of the validation layer so far; empty if it is off.
  std::vector<std::string> validation_messages() const;
  // The emulator's findings so far.
  std::vector<emulator::Finding> findings() const;

  const std::shared_ptr<Context>& context() const { return context_; }

 private:
  std::shared_ptr<Context> context_;
};

}  // namespace eyeray::engine::gpu
