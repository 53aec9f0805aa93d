// Points on surfaces that emit, chosen at random: in float64, from the formulas.
#pragma once

#include <utility>

#include "host/scene/emitters.hpp"

namespace eyeray::engine::reference {

struct EmitterSample {
  Vec3 position;
  Vec3 normal;  // unit, of either side; of closed surfaces outward
  Vec2 uv{0};   // as textures have it; of a triangle the weights of the second and the third corner
};

// A point for `from` to be lit from; u: two random numbers in [0, 1).
EmitterSample sample_emitter(const EmitterForm& form, const Vec3& from, const Vec2& u);
// By solid angle at `from`, the density with which that chooses `place`.
double emitter_density(const EmitterForm& form, const Vec3& from, const EmitterSample& place);

// The radiance that such a point emits towards `from`.
Vec3 emitter_radiance(const Scene& scene, const Emitter& emitter, const EmitterSample& place,
                      const Vec3& from);

// Evenly on the disk of radius 1. Shirley, Chiu: A Low Distortion Map Between Disk and Square, 1997.
Vec2 on_disk(const Vec2& u);
// Two unit vectors that are perpendicular to the unit vector n and to each other. All executors choose the
// same ones.
std::pair<Vec3, Vec3> tangents(const Vec3& n);

}  // namespace eyeray::engine::reference
