#include "host/render/light_meter.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "host/core/grid.hpp"
#include "host/scene/luminance.hpp"

namespace eyeray::engine::render {
namespace {

constexpr double mean_light = 0.36;
constexpr double most_stops = 32;
constexpr int pixels_across = 96;  // pixels of the coarse grid on its longer side
constexpr int square = 4;          // pixels on a side of the squares, whose means have less noise
constexpr size_t tenth = 10;

}  // namespace

double exposure_for(const image::Image& picture) {
  std::vector<double> logarithms;
  for (int y = 0; y < picture.height(); y += square)
    for (int x = 0; x < picture.width(); x += square) {
      double sum = 0, pixels = 0;
      for (int j = y; j < std::min(y + square, picture.height()); ++j)
        for (int i = x; i < std::min(x + square, picture.width()); ++i) {
          const float* const pixel = picture.pixel(i, j);
          sum += luminance({pixel[0], pixel[1], pixel[2]});
          pixels += picture.channels() == 4 ? double(pixel[3]) : 1;
        }
      if (sum > 0 && std::isfinite(sum) && pixels > 0) logarithms.push_back(std::log2(sum / pixels));
    }
  if (logarithms.empty()) return 0;
  std::ranges::sort(logarithms);
  const size_t part = logarithms.size() / tenth;
  const double sum =
      std::accumulate(logarithms.begin() + ptrdiff_t(part), logarithms.end() - ptrdiff_t(part), 0.0);
  const double mean = sum / double(logarithms.size() - 2 * part);
  const double bright = logarithms[logarithms.size() - 1 - part];
  return std::clamp(std::min(std::log2(mean_light) - mean, -bright), -most_stops, most_stops);
}

double metered_exposure(const Scene& scene, executors::Executor& executor) {
  if (!scene.image.meters) return scene.image.tone.exposure;
  const Rect whole{0, 0, scene.image.width, scene.image.height};
  const Grid grid(whole, std::max(1, std::max(whole.width, whole.height) / pixels_across));
  std::vector<PixelSample> samples(size_t(grid.pixels()));
  if (!executor.sample(grid, 0, samples)) return 0;
  image::Image picture(grid.width(), grid.height(), 4);
  for (size_t i = 0; i < samples.size(); ++i) {
    float* const pixel = &picture.samples()[4 * i];
    for (int channel = 0; channel < 3; ++channel) pixel[channel] = float(samples[i].color[channel]);
    pixel[3] = float(1 - samples[i].background);
  }
  return exposure_for(picture);
}

}  // namespace eyeray::engine::render
