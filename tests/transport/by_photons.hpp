// Photon mapping where the answer is known, and where `path` knows it. All pixels of a picture gather the
// same photons, so its samples, not its pixels, are estimates independent of each other.
#pragma once

#include <functional>

#include "patch.hpp"

namespace eyeray::engine::test {

// An estimate of the mean of the pixels of `tile`, from the scene's number of samples.
inline Estimate by_samples(const Scene& scene, Backend backend, const Rect& tile = {0, 0, 1, 1}) {
  const auto executor = executors::make_executor(backend, scene, {});
  const int count = std::max(8, scene.image.samples * amount(1, 4, 4) / 4);
  std::vector<PixelSample> pixels(size_t(tile.pixels()));
  std::vector<double> values;
  double mean = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    executor->sample(tile, uint32_t(i), pixels);
    double value = 0;
    for (const PixelSample& pixel : pixels) value += pixel.color.x / double(pixels.size());
    values.push_back(value);
    mean += value / count;
  }
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / (double(count) * (count - 1)))};
}

inline Scene by_photons(Scene scene, int photons, double radius, int samples, int max_depth) {
  scene.render.integrator = IntegratorType::sppm;
  scene.render.photons = photons;
  scene.render.photon_radius = radius;
  scene.render.max_depth = max_depth;
  scene.image.samples = samples;
  return scene;
}

inline void check_photons(const Scene& scene, double expected, double greatest = 0.01,
                          double least_error = 1e-4, const Rect& tile = {0, 0, 1, 1}) {
  CAPTURE(expected);
  for (const Backend backend : {Backend::twin, Backend::reference}) {
    const Estimate found = by_samples(scene, backend, tile);
    CAPTURE(int(backend));
    CAPTURE(found.mean);
    CAPTURE(found.error);
    CHECK(found.error < greatest * expected * amount(2, 1, 1));
    CHECK(std::abs(found.mean - expected) < 5 * found.error + least_error * expected);
  }
}

// Bias grows with the square of the radius. So by Richardson the bias at `radius` is a third of the
// difference between `radius` and its double; it may be at most `most_bias` of the mean.
inline void check_as_paths(const std::function<Scene()>& make, Backend backend, int photons, double radius,
                           int samples, double greatest, double most_bias = 0.005,
                           const Rect& tile = {0, 0, 1, 1}) {
  CAPTURE(int(backend));
  const Scene scene = make();
  const auto gathered = [&](double within) {
    return by_samples(by_photons(make(), photons, within, samples, scene.render.max_depth), backend, tile);
  };
  const Estimate path = estimate(scene, Backend::twin), near = gathered(radius), wide = gathered(2 * radius);
  const double bias = (wide.mean - near.mean) / 3;
  CAPTURE(path.mean);
  CAPTURE(path.error);
  CAPTURE(near.mean);
  CAPTURE(wide.mean);
  CAPTURE(near.error);
  CHECK(near.error < greatest * path.mean * amount(2, 1, 1));
  CHECK(std::abs(bias) < most_bias * path.mean + near.error);
  CHECK(std::abs(near.mean - bias - path.mean) < 5 * std::hypot(1.4 * near.error, wide.error, path.error));
}

}  // namespace eyeray::engine::test
