#include "host/render/brightness.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "host/scene/luminance.hpp"

namespace eyeray::engine::render {
namespace {

size_t bin_of(double luminance) {
  // A NaN, which may have a sign bit, counts as 0.
  return std::bit_cast<uint32_t>(luminance > 0 ? float(luminance) : 0.0f) >> 20;
}

}  // namespace

void Brightness::add(std::span<const PixelSample> samples) {
  for (const PixelSample& sample : samples) ++counts_[bin_of(luminance(sample.color))];
}

void Brightness::add(const Brightness& other) {
  for (size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
}

uint64_t Brightness::above(double luminance) const {
  if (!(luminance > 0)) return 0;
  const auto first = counts_.begin() + std::ptrdiff_t(bin_of(luminance)) + 1;
  return std::accumulate(first, counts_.end(), uint64_t{0});
}

double sum_of_luminances(const image::Image& rows) {
  double sum = 0;
  for (size_t i = 0; i < rows.sample_count(); i += size_t(rows.channels())) {
    const float* const color = &rows.samples()[i];
    sum += luminance(Vec3(color[0], color[1], color[2]));
  }
  return sum;
}

}  // namespace eyeray::engine::render
