// Rare bright samples, found from groups of samples.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/core/halves.hpp"
#include "host/core/vec.hpp"

namespace eyeray::engine::film {

// The samples of a pixel are summed in groups, 8 for each half of the samples (core/halves.hpp). Each group
// gets every eighth sample of its half.
constexpr int groups_of_pixel = 16;
constexpr bool group_is_in_first_half(int group) {
  return group < groups_of_pixel / 2;
}
// The group of sample number `sample`.
constexpr int group_of(uint64_t sample) {
  constexpr uint64_t of_half = groups_of_pixel / 2;
  const uint64_t in_first = first_half_of(sample);
  return int(in_first_half(sample) ? in_first % of_half : of_half + (sample - in_first) % of_half);
}

// The groups of some pixels beside each other.
struct PixelGroups {
  std::span<const float> sums;  // red, green and blue of each group
  uint32_t samples = 0;         // all of the pixel

  uint32_t samples_in(int group) const {
    constexpr uint32_t of_half = groups_of_pixel / 2;
    const auto first = uint32_t(first_half_of(samples));
    const uint32_t all = group_is_in_first_half(group) ? first : samples - first;
    return all / of_half + (uint32_t(group) % of_half < all % of_half);
  }
  Vec3 sum(int group) const {
    return Vec3(sums[size_t(3 * group)], sums[size_t(3 * group + 1)], sums[size_t(3 * group + 2)]);
  }
};

// Returns for each pixel the groups that do not count, as bits. `pixels` lie beside each other.
//
// A group is an outlier if its mean is far brighter than those of nearly all groups of these pixels: twice
// their mean, and ten standard deviations. A pixel has at most two outliers: if it has more of them, all of
// its groups count, since its light is no accident. `least`: no group with at most this mean is an outlier.
//
// After the median of means, and the rejection of outliers by density: DeCoro, Weyrich and Rusinkiewicz,
// "Density-based outlier rejection in Monte Carlo rendering" (Pacific Graphics 2010).
std::vector<uint32_t> outliers_of(std::span<const PixelGroups> pixels, double least);

}  // namespace eyeray::engine::film
