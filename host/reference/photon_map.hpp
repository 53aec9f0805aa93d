// The photons of one sample, and the search for those near a point, in float64 with the reference's own grid.
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

// A photon, as stored at a surface that scatters light widely.
struct Photon {
  Vec3 position;
  Vec3 direction;   // unit, back along the photon's ray
  Vec3 normal;      // unit, geometric, on the side that the photon hit
  Vec3 flux;        // the photon's flux / index² there, times the number of the sample's photons
  uint32_t number;  // among the sample's photons
  int depth;        // how often the photon was scattered before
};

class PhotonMap {
 public:
  // Traces and sorts the photons of sample `index`. The photons of `left_out` contribute nothing.
  PhotonMap(const Tracer& tracer, uint32_t index, std::span<const uint32_t> left_out);

  // Calls visit(photon) once for each photon not farther from p than radius(), and perhaps for more.
  template <typename Visit>
  void near(const Vec3& p, const Visit& visit) const;

  double radius() const { return radius_; }
  uint32_t count() const { return uint32_t(ways_.size()); }
  const std::vector<Photon>& photons() const { return photons_; }
  const std::vector<PhotonWay>& ways() const { return ways_; }

 private:
  // The whole coordinates of the cell that contains p. Cells are cubes as wide as two radii.
  Vec3 cell_of(const Vec3& p) const;
  // The number of a cell. Cells 2²¹ apart may share one.
  static uint64_t number_of(const Vec3& cell);
  std::pair<size_t, size_t> in_cell(uint64_t cell) const;

  double radius_;
  std::vector<uint64_t> cells_;  // the cell of each photon
  std::vector<Photon> photons_;  // sorted by cell
  std::vector<PhotonWay> ways_;
};

template <typename Visit>
void PhotonMap::near(const Vec3& p, const Visit& visit) const {
  // Cells of other corners are counted from the lowest: found by their own points, two may be rounded to one.
  const Vec3 lowest = cell_of(p - radius_);
  for (int corner = 0; corner < 8; ++corner) {
    const auto [begin, end] = in_cell(number_of(lowest + Vec3(corner & 1, corner >> 1 & 1, corner >> 2)));
    for (size_t i = begin; i < end; ++i) visit(photons_[i]);
  }
}

// The photon maps of a scene's samples, each made on first use. May be called from many threads at once.
class PhotonMaps {
 public:
  std::shared_ptr<const PhotonMap> of_sample(const Tracer& tracer, uint32_t index);
  // From now on these photons of each sample contribute nothing.
  void leave_out(LeftOutPhotons photons);

 private:
  static constexpr size_t most_kept = 8;

  std::mutex mutex_;
  std::map<uint32_t, std::shared_ptr<const PhotonMap>> kept_;
  LeftOutPhotons left_out_;
};

}  // namespace eyeray::engine::reference
