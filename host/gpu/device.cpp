#include "host/gpu/device.hpp"

#include "host/gpu/context.hpp"
#include "host/gpu/physical_device.hpp"

namespace eyeray::engine::gpu {

std::vector<DeviceInfo> list_devices() {
  const Instance instance(DeviceOptions{});
  std::vector<DeviceInfo> devices;
  for (VkPhysicalDevice handle : instance.physical_devices())
    devices.push_back(describe(handle, int(devices.size())));
  return devices;
}

Device::Device(const DeviceOptions& options) : context_(std::make_shared<Context>(options)) {}

const DeviceInfo& Device::info() const {
  return context_->info;
}
bool Device::shares_memory() const {
  return context_->shares_memory;
}
std::vector<std::string> Device::validation_messages() const {
  return context_->instance->validation_messages();
}

}  // namespace eyeray::engine::gpu
