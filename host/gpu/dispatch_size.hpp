// The size of dispatches, so that none keeps a device busy for long.
#pragma once

#include <algorithm>
#include <cstdint>

#include "host/gpu/device.hpp"

namespace eyeray::engine::gpu {

// The longest duration of one dispatch on a watched device, in seconds.
inline constexpr double longest_dispatch = 0.1;

// True if an operating system may watch the device: Windows resets a GPU that is busy for 2 s, and desktops
// freeze meanwhile. No system watches a CPU.
inline bool watched(const DeviceInfo& device) {
  return device.type != DeviceType::cpu;
}

// The number of items, such as pixels, to dispatch at a time. It is learnt from the duration of the last
// dispatch.
class DispatchSize {
 public:
  // `most`: the most items of one dispatch.
  DispatchSize(const DeviceInfo& device, int64_t most)
      : wanted_seconds_(wanted_seconds(device)), most_(most), items_(watched(device) ? least : 1 << 14) {}

  // The seconds that a dispatch should take. On a watched device the next items may each cost four times as
  // much as the last ones. On a CPU the purpose is only that Ctrl-C works.
  static double wanted_seconds(const DeviceInfo& device) {
    return watched(device) ? longest_dispatch / 4 : 0.05;
  }

  int64_t items() const { return items_; }
  void took(int64_t items, double seconds) {
    const double wanted = double(items) * wanted_seconds_ / std::max(seconds, 1e-6);
    items_ = std::clamp(int64_t(wanted), least, std::min(8 * items_, most_));
  }

 private:
  static constexpr int64_t least = 64;  // one workgroup

  double wanted_seconds_;
  int64_t most_;
  int64_t items_;
};

}  // namespace eyeray::engine::gpu
