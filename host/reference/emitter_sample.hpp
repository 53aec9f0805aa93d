// Randomly chosen points on emitting surfaces, in float64, from the formulas.
#pragma once

#include <utility>

#include "host/scene/emitters.hpp"

namespace eyeray::engine::reference {

struct EmitterSample {
  Vec3 position;
  Vec3 normal;  // unit, on either side; outward for closed surfaces
  Vec2 uv{0};   // as textures read it; for a triangle the weights of the second and the third corner
};

// Samples a point of the form that lights the point `from`. u: two random numbers in [0, 1).
EmitterSample sample_emitter(const EmitterForm& form, const Vec3& from, const Vec2& u);
// The density, by solid angle at `from`, with which sample_emitter chooses `point`.
double emitter_density(const EmitterForm& form, const Vec3& from, const EmitterSample& point);

// The radiance that `point` of the emitter emits towards `from`.
Vec3 emitter_radiance(const Scene& scene, const Emitter& emitter, const EmitterSample& point,
                      const Vec3& from);

// Maps u to a uniform point on the disk of radius 1. Shirley, Chiu: A Low Distortion Map Between Disk and
// Square, 1997.
Vec2 on_disk(const Vec2& u);
// Two unit vectors that are perpendicular to the unit vector n and to each other. All executors choose the
// same ones.
std::pair<Vec3, Vec3> tangents(const Vec3& n);

}  // namespace eyeray::engine::reference
