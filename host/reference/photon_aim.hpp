// Aims half of a light's photons at objects that focus light. A photon's density, in float64, is that of
// aimed and unaimed photons together.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "host/scene/photons.hpp"

namespace eyeray::engine::reference {

// A target as seen from the start of photons: a cap of the sphere of directions, or a disk of positions. By
// Archimedes, a cap has the area of a disk whose radius is the chord from the cap's middle to its rim. So a
// point is inside a cap or a disk if its `distance` from the middle satisfies π distance² < area.
struct Window {
  Vec3 middle;
  double area;
};

// The windows of directions from point p on a surface of normal n; n = 0 if p is on no surface. There is no
// window for a target that contains p or is below the horizon.
std::vector<Window> windows_from(const PhotonSettings& settings, const Vec3& p, const Vec3& n);
// The windows of positions for light from direction d. Positions are on a plane perpendicular to d, relative
// to the scene's middle.
std::vector<Window> windows_along(const PhotonSettings& settings, const Vec3& d);

struct Aimed {
  Vec3 at;             // a direction or position
  bool by_aim;         // true if a window chose `at`, false if the light's own density did
  uint64_t event = 0;  // the value of Event::aim
  double density = 0;  // with which windows choose `at`

  // The weight of a photon, relative to an unaimed one. own: the density with which the light itself would
  // choose `at`.
  double weight(double own) const;
};

// By the random number `random`, chooses either `at_random`, or in(window), a point of a window. The
// probability of a window is proportional to its area.
Aimed aimed(std::span<const Window> windows, double random, const Vec3& at_random,
            const std::function<Vec3(const Window&)>& in);

}  // namespace eyeray::engine::reference
