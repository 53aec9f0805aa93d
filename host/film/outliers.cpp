#include "host/film/outliers.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "host/scene/luminance.hpp"

namespace eyeray::engine::film {
namespace {

constexpr double times_of_mean = 2, times_of_deviation = 10;
constexpr int most_of_pixel = 2;
// The brightest groups of all pixels do not count in mean and deviation: one in so many.
constexpr size_t share_of_brightest = 64;

// The mean luminance of a group; NaN if it has no samples.
double brightness(const PixelGroups& pixel, int group) {
  return luminance(pixel.sum(group)) / pixel.samples_in(group);
}

}  // namespace

std::vector<uint32_t> outliers_of(std::span<const PixelGroups> pixels, double least) {
  std::vector<double> all;
  for (const PixelGroups& pixel : pixels)
    for (int group = 0; group < groups_of_pixel; ++group)
      if (const double value = brightness(pixel, group); std::isfinite(value)) all.push_back(value);
  std::vector<uint32_t> found(pixels.size(), 0);
  const size_t brightest = (all.size() + share_of_brightest - 1) / share_of_brightest;
  if (all.size() < 2 * brightest + 2) return found;
  std::ranges::sort(all);
  all.resize(all.size() - brightest);
  double mean = 0, variance = 0;
  for (const double each : all) mean += each / double(all.size());
  for (const double each : all) variance += (each - mean) * (each - mean) / double(all.size());
  const double most = std::max(least, times_of_mean * mean + times_of_deviation * std::sqrt(variance));

  for (size_t i = 0; i < pixels.size(); ++i) {
    for (int group = 0; group < groups_of_pixel; ++group)
      if (brightness(pixels[i], group) > most) found[i] |= uint32_t{1} << group;
    const int most_here = std::min(most_of_pixel, int(pixels[i].samples) - 1);
    if (std::popcount(found[i]) > most_here) found[i] = 0;
  }
  return found;
}

}  // namespace eyeray::engine::film
