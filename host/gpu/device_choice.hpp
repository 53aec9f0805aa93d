#pragma once

#include <span>
#include <string_view>

#include "host/gpu/device.hpp"

namespace eyeray::engine::gpu {

// The device that `select` means: "auto" is the best usable one (discrete, then integrated, virtual, cpu,
// other). "cpu" and "gpu" are the best of that type. A number is an index. Anything else is a part of a name,
// in upper or lower case. Error (no_device), with the reasons and the list of the devices, when there is no
// such device or it is not usable.
const DeviceInfo& choose_device(std::span<const DeviceInfo> devices, std::string_view select);

// The same error if this machine lacks the device that the options select. Opens no device.
void check_choice(const DeviceOptions& options);

}  // namespace eyeray::engine::gpu
