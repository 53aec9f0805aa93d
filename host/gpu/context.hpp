// The Vulkan objects that buffers, kernels and command lists share; for the .cpp files of this layer.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "host/core/error.hpp"
#include "host/emulator/emulator.hpp"
#include "host/gpu/device.hpp"
#include "host/gpu/instance.hpp"

namespace eyeray::engine::gpu {

// Makes later stages wait for earlier ones, and earlier writes visible to later reads.
void record_barrier(VkCommandBuffer commands, VkPipelineStageFlags stages, VkAccessFlags written,
                    VkPipelineStageFlags later_stages, VkAccessFlags read);

struct Context {
  explicit Context(const DeviceOptions& options);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // Begins to record the only command buffer anew.
  void begin();
  // Drops the commands recorded since begin(), if they were not submitted.
  void cancel() noexcept;
  // Ends the command buffer, submits it and waits until the device is done. Error (timed_out) after the
  // time-out, (interrupted) when a signal requested a stop and the device did not finish soon, (no_device)
  // when the driver fails. After an error at or after the submission, the context is abandoned.
  void submit_and_wait(std::string_view what, double timeout_seconds);
  void submit_and_wait(std::string_view what) { submit_and_wait(what, options.timeout_seconds); }
  // The error that `what` took longer than the time-out.
  Error time_out(std::string_view what, double seconds) const;

  DeviceOptions options;
  // The emulator has none of the objects below that need a VkDevice: they are null.
  const bool emulates;
  emulator::Findings findings;
  emulator::Trace* trace = nullptr;
  std::vector<std::function<void(emulator::Work)>> dispatches;  // recorded for the emulator
  std::unique_ptr<Instance> instance;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  DeviceInfo info;
  VkPhysicalDeviceMemoryProperties memory{};
  bool shares_memory = false;
  bool draws = false;             // whether the queue can draw
  bool keeps_statistics = false;  // kernels keep statistics, for Kernel::executables
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;  // null on hardware that only compiles, as are the next four
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
  VkQueryPool timestamps = VK_NULL_HANDLE;  // two timestamps; null if unsupported
  uint32_t timestamp_bits = 0;
  double timestamp_seconds = 0;  // the duration of one tick
  bool recording = false;
  bool abandoned = false;  // nobody waits for the device, which may be busy: destroy none of its objects

 private:
  void emulate(std::string_view what, double timeout_seconds);
  struct InstanceOnly {};
  Context(const DeviceOptions& options,
          InstanceOnly);  // the public constructor completes such a context, and cleans up if it cannot
  void choose();
  void create_device();
  void create_timestamps(uint32_t bits);
  [[noreturn]] void abandon(const Error& error);
};

}  // namespace eyeray::engine::gpu
