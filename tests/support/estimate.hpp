// An executor's estimate of a picture's mean radiance, and its standard error.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/executors/executor.hpp"
#include "tests/support/amount.hpp"
#include "tests/support/scenes.hpp"

namespace eyeray::engine::test {

struct Estimate {
  double mean;
  double error;  // standard
};

// An estimate from the first channel, in which all pixels estimate the same value. Takes an eighth of the
// samples under EYERAY_FEW_TESTS.
inline Estimate estimate(const Scene& scene, executors::Backend backend,
                         const executors::ExecutorOptions& options = {}) {
  const auto executor = executors::make_executor(backend, scene, options);
  const Rect tile{0, 0, scene.image.width, scene.image.height};
  const auto pixels = size_t(tile.pixels());
  std::vector<PixelSample> samples(pixels);
  std::vector<double> sums(pixels);
  const int count = std::max(1, scene.image.samples * amount(1, 8, 8) / 8);
  for (int i = 0; i < count; ++i) {
    executor->sample(tile, uint32_t(i), samples);
    for (size_t p = 0; p < pixels; ++p) sums[p] += samples[p].color.x / count;
  }
  double mean = 0, squares = 0;
  for (const double value : sums) mean += value / double(pixels);
  for (const double value : sums) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / double(pixels * (pixels - 1)))};
}

// The limit of an estimate's standard error, as a share of the mean.
inline double greatest_error() {
  return 0.005 * amount(8, 1, 1);
}

}  // namespace eyeray::engine::test
