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

// Spheres around all shapes and meshes whose material has only sharp lobes: glass, mirrors, smooth metal,
// panes. If there are more than `most_photon_targets`, objects near to each other share a sphere. Unbounded
// shapes, and objects whose radius exceeds half of `reach`, the scene's radius, have no sphere: photons hit
// those without being aimed.
std::vector<PhotonTarget> photon_targets(const Scene& scene, double reach);

// True if the material may store photons. A roughness from a texture may have any value.
bool scatters_widely(const Material& material);

}  // namespace eyeray::engine
