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
  // Error (no_device), which names the packages to install, when there is no loader, no driver or no
  // validation layer. If drivers take longer than the time-out, here or in physical_devices(), the process
  // ends (core/termination.hpp).
  explicit Instance(const DeviceOptions& options);
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  // Every physical device. Error (no_device) if there is none.
  std::vector<VkPhysicalDevice> physical_devices() const;
  std::vector<std::string> validation_messages() const;

 private:
  // Makes an instance that the public constructor completes, or cleans up if it cannot.
  explicit Instance(double timeout_seconds) : timeout_seconds_(timeout_seconds) {}

  double timeout_seconds_;

  VkInstance instance_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  std::unique_ptr<ValidationLog> log_ = std::make_unique<ValidationLog>();
};

}  // namespace eyeray::engine::gpu
