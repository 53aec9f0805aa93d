#include "host/reference/photon_map.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/core/parallel_for.hpp"
#include "host/reference/path_sample.hpp"

namespace eyeray::engine::reference {

PhotonMap::PhotonMap(const Tracer& tracer, uint32_t index, std::span<const uint32_t> left_out) {
  const PhotonSources sources(tracer);
  const PhotonSettings& settings = sources.settings();
  radius_ = photon_radius(settings, index);

  // Trace the photons.
  ways_.resize(settings.count);
  std::vector<std::vector<Photon>> stopped(settings.count);
  constexpr uint32_t at_once = 256;
  parallel_for_alone(0, int((settings.count + at_once - 1) / at_once), [&](int piece) {
    const uint32_t begin = uint32_t(piece) * at_once, end = std::min(settings.count, begin + at_once);
    for (uint32_t number = begin; number < end; ++number)
      ways_[number] =
          PathSample(tracer, {photons_of | index, number}, {}, {}).photon(sources, stopped[number]);
  });
  for (const uint32_t number : left_out)
    for (Photon& photon : stopped[number]) photon.flux = Vec3(0);

  // Sort the photons by cell.
  std::vector<Photon> all;
  for (const auto& its : stopped) all.insert(all.end(), its.begin(), its.end());
  std::vector<std::pair<uint64_t, size_t>> order(all.size());
  for (size_t i = 0; i < all.size(); ++i) order[i] = {number_of(cell_of(all[i].position)), i};
  std::ranges::sort(order);
  for (const auto& [cell, i] : order) {
    cells_.push_back(cell);
    photons_.push_back(all[i]);
  }
}

Vec3 PhotonMap::cell_of(const Vec3& p) const {
  return glm::clamp(glm::floor(p / (2 * radius_)), -0x1p50, 0x1p50);
}

uint64_t PhotonMap::number_of(const Vec3& cell) {
  uint64_t number = 0;
  for (int axis = 0; axis < 3; ++axis) number = number << 21 | (uint64_t(int64_t(cell[axis])) & 0x1fffff);
  return number;
}

std::pair<size_t, size_t> PhotonMap::in_cell(uint64_t cell) const {
  const auto [begin, end] = std::equal_range(cells_.begin(), cells_.end(), cell);
  return {size_t(begin - cells_.begin()), size_t(end - cells_.begin())};
}

std::shared_ptr<const PhotonMap> PhotonMaps::of_sample(const Tracer& tracer, uint32_t index) {
  const std::lock_guard lock(mutex_);
  if (const auto found = kept_.find(index); found != kept_.end()) return found->second;
  if (kept_.size() == most_kept) kept_.erase(kept_.begin());
  auto map = std::make_shared<const PhotonMap>(tracer, index, left_out_.of(index));
  kept_.emplace(index, map);
  return map;
}

void PhotonMaps::leave_out(LeftOutPhotons photons) {
  const std::lock_guard lock(mutex_);
  left_out_ = std::move(photons);
  kept_.clear();
}

}  // namespace eyeray::engine::reference
