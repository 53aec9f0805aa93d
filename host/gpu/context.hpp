// Everything of Vulkan that buffers, kernels and command lists share; for the .cpp files of this layer.
#pragma once

#include <string_view>

#include "host/core/error.hpp"
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

  // Starts the one command buffer anew.
  void begin();
  // Gives up the commands recorded since, if they were not submitted.
  void cancel() noexcept;
  // Ends it, submits it and waits until the device is done. Error (timed_out) after the time-out,
  // (interrupted) when the user requested a stop and the device did not finish soon, (no_device) when the
  // driver fails. From the submission on, the context is then abandoned.
  void submit_and_wait(std::string_view what, double timeout_seconds);
  void submit_and_wait(std::string_view what) { submit_and_wait(what, options.timeout_seconds); }
  // The error that `what` took longer than the time-out.
  Error time_out(std::string_view what, double seconds) const;

  DeviceOptions options;
  std::unique_ptr<Instance> instance;
  VkPhysicalDevice physical = VK_NULL_HANDLE;
  DeviceInfo info;
  VkPhysicalDeviceMemoryProperties memory{};
  bool shares_memory = false;
  bool draws = false;  // whether its queue does
  VkDevice device = VK_NULL_HANDLE;
  VkQueue queue = VK_NULL_HANDLE;
  VkCommandPool pool = VK_NULL_HANDLE;
  VkCommandBuffer commands = VK_NULL_HANDLE;
  VkFence fence = VK_NULL_HANDLE;
  VkQueryPool timestamps = VK_NULL_HANDLE;  // two; null where they are unsupported
  uint32_t timestamp_bits = 0;
  double timestamp_seconds = 0;  // of one tick
  bool recording = false;
  bool abandoned = false;  // the device may be busy, and is not waited for: nothing of it may be destroyed

 private:
  struct InstanceOnly {};
  Context(const DeviceOptions& options,
          InstanceOnly);  // the public constructor completes it, and cleans up if it cannot
  void choose();
  void create_device();
  void create_timestamps(uint32_t bits);
  [[noreturn]] void abandon(const Error& error);
};

}  // namespace eyeray::engine::gpu
