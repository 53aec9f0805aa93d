#include "host/gpu/device.hpp"

#include "host/gpu/context.hpp"
#include "host/gpu/device_choice.hpp"
#include "host/gpu/physical_device.hpp"

namespace eyeray::engine::gpu {
namespace {

std::vector<DeviceInfo> devices_of(const DeviceOptions& options) {
  const Instance instance(options);
  std::vector<DeviceInfo> devices;
  for (VkPhysicalDevice handle : instance.physical_devices())
    devices.push_back(describe(handle, int(devices.size())));
  return devices;
}

}  // namespace

std::vector<DeviceInfo> list_devices() {
  return devices_of({});
}

void check_choice(const DeviceOptions& options) {
  static_cast<void>(choose_device(devices_of(options), options.select));
}

Device::Device(const DeviceOptions& options) : context_(std::make_shared<Context>(options)) {}

void trace(Device& device, emulator::Trace& invocation) {
  CHECK(device.context()->emulates);
  device.context()->trace = &invocation;
}

std::vector<emulator::Finding> Device::findings() const {
  return context_->findings.all();
}
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
