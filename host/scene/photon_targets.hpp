// The targets at which photons are aimed: objects that focus light into caustics, and are hit by few photons
// if they are small.
#pragma once

#include <vector>

#include "host/core/vec.hpp"

namespace eyeray::engine {

class Material;
struct Scene;

// A sphere in the world.
struct PhotonTarget {
  Vec3 center;
  double radius;
};

inline constexpr size_t most_photon_targets = 16;

// Spheres around all shapes and meshes whose material has sharp lobes alone: glass, mirrors, smooth metal,
// panes. Where there are more than `most_photon_targets`, those that are near to each other share one.
// Endless shapes, and objects wider than half of `reach`, the scene's radius, have none: photons find those
// by themselves.
std::vector<PhotonTarget> photon_targets(const Scene& scene, double reach);

// True if the material may store photons. A roughness from a texture may have any value.
bool scatters_widely(const Material& material);

}  // namespace eyeray::engine
