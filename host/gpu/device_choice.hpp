#pragma once

#include <span>
#include <string_view>

#include "host/gpu/device.hpp"

namespace eyeray::engine::gpu {

// The device that `select` means: "auto" is the best usable one (discrete, then integrated, virtual, cpu,
// other). "cpu" and "gpu" are the best of that sort. A number is an index, anything else a part of a name in
// any case. Error (no_device) when there is none or it is not usable, with the reasons and the list of the
// devices.
const DeviceInfo& choose_device(std::span<const DeviceInfo> devices, std::string_view select);

}  // namespace eyeray::engine::gpu
