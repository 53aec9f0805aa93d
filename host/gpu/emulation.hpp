// The emulator in place of a device (DeviceOptions::emulate).
#pragma once

#include "host/gpu/device.hpp"

namespace eyeray::engine::emulator {
struct Trace;
}

namespace eyeray::engine::gpu {

// Traces an invocation of the next dispatches of an emulated device. `invocation` outlives them.
void trace(Device& device, emulator::Trace& invocation);

}  // namespace eyeray::engine::gpu
