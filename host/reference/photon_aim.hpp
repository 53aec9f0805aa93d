// Half of a light's photons are aimed at focusing objects: in float64, the density of both ways together.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "host/scene/photons.hpp"

namespace eyeray::engine::reference {

// A target as seen from the start of photons: a cap of the sphere of directions, or a disk of positions. By
// Archimedes, a cap has the area of a disk as wide as its chord. So a point of either is within if its
// `distance` from the middle satisfies π distance² < area.
struct Window {
  Vec3 middle;
  double area;
};

// From a point on a surface of normal n, or with n = 0 from one in space: directions. None around the point
// itself or below the horizon.
std::vector<Window> windows_from(const PhotonSettings& settings, const Vec3& p, const Vec3& n);
// The windows for light from direction d: positions relative to the scene's middle, on a plane perpendicular
// to d.
std::vector<Window> windows_along(const PhotonSettings& settings, const Vec3& d);

struct Aimed {
  Vec3 at;             // a direction or position
  bool by_aim;         // by a window, not by the light's own density
  uint64_t event = 0;  // Event::aim
  double density = 0;  // with which such are aimed at

  // The weight of a photon, relative to an unaimed one. own: the density with which the light itself would
  // choose the same.
  double weight(double own) const;
};

// By one random number either into a window, by in(window), each as often as it is large, or by_chance.
Aimed aimed(std::span<const Window> windows, double chance, const Vec3& by_chance,
            const std::function<Vec3(const Window&)>& in);

}  // namespace eyeray::engine::reference
