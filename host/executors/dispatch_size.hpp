#pragma once

#include <algorithm>
#include <cstdint>

namespace eyeray::engine::executors {

// The most pixels of one dispatch: 32 MiB of samples.
inline constexpr int64_t most_pixels = 1 << 20;

// The number of pixels to dispatch at a time, learnt from the durations of the last dispatches.
class DispatchSize {
 public:
  int rows(int width) const { return int(std::max<int64_t>(1, pixels_ / width)); }
  void took(int64_t pixels, double seconds) {
    const double wanted = double(pixels) * wanted_seconds / std::max(seconds, 1e-6);
    pixels_ = std::clamp(int64_t(wanted), int64_t{64}, std::min(8 * pixels_, most_pixels));
  }

 private:
  // Short enough for a desktop's GPU watchdog and for Ctrl-C.
  static constexpr double wanted_seconds = 0.05;

  int64_t pixels_ = 1 << 14;
};

}  // namespace eyeray::engine::executors
