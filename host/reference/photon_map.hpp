// The photons of one sample, and those that lie near a point: in float64, with the reference's own grid.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "host/scene/photons.hpp"

namespace eyeray::engine::reference {

class Tracer;

// A photon where a surface has stopped it that scatters light widely.
struct Photon {
  Vec3 position;
  Vec3 direction;   // unit, towards where it came from
  Vec3 normal;      // unit, geometric, on the side that it came to
  Vec3 flux;        // its flux, over index² there, times the number of all
  uint32_t number;  // of those of its sample
  int depth;        // how often it was scattered before
};

class PhotonMap {
 public:
  // Sends out and sorts those of sample `index`; `left_out` bring nothing.
  PhotonMap(const Tracer& tracer, uint32_t index, std::span<const uint32_t> left_out);

  // Calls visit(photon) for each not farther from p than radius(), and perhaps more.
  template <typename Visit>
  void near(const Vec3& p, const Visit& visit) const;

  double radius() const { return radius_; }
  uint32_t count() const { return uint32_t(ways_.size()); }
  const std::vector<Photon>& photons() const { return photons_; }
  const std::vector<PhotonWay>& ways() const { return ways_; }

 private:
  // Cubes as wide as two radii, each with a number; cubes 2²¹ apart may share it.
  uint64_t cell(const Vec3& p) const;
  std::pair<size_t, size_t> in_cell(uint64_t cell) const;

  double radius_;
  std::vector<uint64_t> cells_;  // of each photon
  std::vector<Photon> photons_;  // by cell
  std::vector<PhotonWay> ways_;
};

template <typename Visit>
void PhotonMap::near(const Vec3& p, const Visit& visit) const {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 offset(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const auto [begin, end] = in_cell(cell(p + radius_ * offset));
    for (size_t i = begin; i < end; ++i) visit(photons_[i]);
  }
}

// The photon maps of a scene's samples, each made on first use. May be called from many threads at once.
class PhotonMaps {
 public:
  std::shared_ptr<const PhotonMap> of_sample(const Tracer& tracer, uint32_t index);
  // From now on these photons of each sample bring nothing.
  void leave_out(LeftOutPhotons photons);

 private:
  static constexpr size_t most_kept = 8;

  std::mutex mutex_;
  std::map<uint32_t, std::shared_ptr<const PhotonMap>> kept_;
  LeftOutPhotons left_out_;
};

}  // namespace eyeray::engine::reference
