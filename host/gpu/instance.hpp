// The Vulkan loader and an instance, for the .cpp files of this layer.
#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "host/gpu/device.hpp"
#include "host/gpu/vulkan.hpp"

namespace eyeray::engine::gpu {

// The messages of the validation layer, from any thread.
struct ValidationLog {
  std::mutex mutex;
  std::vector<std::string> messages;
};

class Instance {
 public:
  // Error (no_device) that names the packages to install when there is no loader, no driver or no validation
  // layer. Drivers that take longer than the time-out end the process (core/termination.hpp), as in
  // physical_devices().
  explicit Instance(const DeviceOptions& options);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  // Never empty: Error (no_device) instead.
  std::vector<VkPhysicalDevice> physical_devices() const;
  std::vector<std::string> validation_messages() const;

 private:
  // The public constructor completes it, and cleans up if it cannot.
  explicit Instance(double timeout_seconds) : timeout_seconds_(timeout_seconds) {}

  double timeout_seconds_;

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::unique_ptr<ValidationLog> log_ = std::make_unique<ValidationLog>();
};

}  // namespace eyeray::engine::gpu
