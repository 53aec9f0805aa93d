#include "host/verify/photon_judge.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/parallel_for.hpp"
#include "host/reference/photon_map.hpp"
#include "host/reference/photon_traces.hpp"
#include "host/reference/trail.hpp"
#include "host/rounding/ways.hpp"

namespace eyeray::engine::verify {
namespace {

constexpr uint32_t seeds = 64;
// At a corner, one rounding in a hundred or fewer leads the way that float32 takes. If at most
// `most_searched` photons are left unexplained, the search goes on up to the seed `more_seeds`; with more,
// the gate fails soon.
constexpr uint32_t more_seeds = 4096;
constexpr size_t most_searched = 16;

// A photon that arrives elsewhere in float32 than in the reference.
struct Apart {
  uint32_t number;
  PhotonWay twin, reference;

  // True if it took another path; else it is displaced.
  bool diverged() const { return twin.trail != reference.trail; }
};

// The differences of the twin's photon from the reference's, which took the same path: each as a share of the
// largest that counts as none.
struct Differences {
  double position, direction, flux;

  double largest() const { return std::max({position, direction, flux}); }
};
Differences differences(const PhotonWay& a, const PhotonWay& b, double radius) {
  const auto share = [](const Vec3& x, const Vec3& y, double least) {
    return x == y ? 0 : glm::length(x - y) / least;
  };
  return {share(a.positions, b.positions, rounding::photon_displacement * radius),
          share(a.directions, b.directions, rounding::photon_turn),
          share(a.flux, b.flux,
                rounding::photon_flux_change *
                    std::max(glm::length(b.flux), rounding::photon_least_flux * glm::length(b.sent)))};
}

// True if the reference explains the photon by other rounding: it takes all of the twin's path, or its own
// path and then differs at least half as much, where the twin differs most.
bool explained(const Apart& photon, const reference::PhotonTraces& traces, uint32_t index, double radius,
               uint32_t first_seed, uint32_t last_seed) {
  const Differences found = differences(photon.twin, photon.reference, radius);
  const auto most = found.position == found.largest()    ? &Differences::position
                    : found.direction == found.largest() ? &Differences::direction
                                                         : &Differences::flux;
  const auto explains = [&](const rounding::Displacement& rounded) {
    const PhotonWay way = traces.trace(index, photon.number, rounded).way;
    return way.trail == photon.twin.trail &&
           (photon.diverged() || differences(way, photon.reference, radius).*most >= found.*most / 2);
  };
  for (const double scale : rounding::photon_scales)
    for (uint32_t seed = first_seed; seed <= last_seed; ++seed)
      if (std::ranges::any_of(rounding::ways_of_photon(scale, seed), explains)) return true;
  return false;
}

std::string describe(const Apart& photon, const reference::PhotonTraces& traces, uint32_t index) {
  if (!photon.diverged())
    return fmt::format(
        "photon {} of sample {}, which is displaced by {:.3g}, turned by {:.3g}, "
        "and carries {:.4g} times the flux",
        photon.number, index, glm::length(photon.twin.positions - photon.reference.positions),
        glm::length(photon.twin.directions - photon.reference.directions),
        glm::length(photon.twin.flux) / glm::length(photon.reference.flux));
  std::string way;
  for (const uint32_t event : traces.trace(index, photon.number, {}).events)
    way += (way.empty() ? "" : ", ") + reference::describe_event(event);
  return fmt::format("photon {} of sample {}; the reference's {}", photon.number, index, way);
}

}  // namespace

JudgedPhotons judge_photons(const Scene& scene,
                            const std::function<std::vector<PhotonWay>(uint32_t index)>& ways,
                            const reference::Renderer& renderer) {
  JudgedPhotons judged;
  compare::PhotonTally& tally = judged.tally;
  tally.sent = int64_t{scene.render.photons} * scene.image.samples;
  tally.depth = scene.render.max_depth;
  const reference::PhotonTraces traces(renderer.tracer());
  for (uint32_t index = 0; index < uint32_t(scene.image.samples); ++index) {
    // Find the photons that differ.
    const std::vector<PhotonWay> a = ways(index), b = renderer.tracer().photons(index)->ways();
    CHECK_EQ(a.size(), b.size());
    const double radius = photon_radius(photon_settings(scene), index);
    std::vector<Apart> apart;
    for (uint32_t number = 0; number < a.size(); ++number) {
      const Apart photon{number, a[number], b[number]};
      if (!photon.diverged() && differences(a[number], b[number], radius).largest() <= 1) continue;
      apart.push_back(photon);
      ++(photon.diverged() ? tally.diverged : tally.displaced);
    }
    std::vector<uint32_t>& left_out = judged.left_out.by_sample.emplace_back();
    for (const Apart& photon : apart) left_out.push_back(photon.number);

    // Explain each photon by the reference, until the gate has failed.
    if (!tally.passes()) continue;
    const auto explain = [&](uint32_t first_seed, uint32_t last_seed) {
      std::vector<char> known(apart.size());
      parallel_for(0, int(apart.size()), [&](int i) {
        known[size_t(i)] = explained(apart[size_t(i)], traces, index, radius, first_seed, last_seed);
      });
      size_t kept = 0;
      for (size_t i = 0; i < apart.size(); ++i)
        if (!known[i]) apart[kept++] = apart[i];
      apart.resize(kept);
    };
    explain(1, seeds);
    if (apart.size() <= most_searched) explain(seeds + 1, more_seeds);
    if (!apart.empty() && tally.unexplained == 0) tally.worst = describe(apart.front(), traces, index);
    tally.unexplained += int64_t(apart.size());
  }
  return judged;
}

}  // namespace eyeray::engine::verify
