// Light from all around, as a picture has it (docs/rendering.md), and how directions in it are chosen.
#pragma once

#include "host/scene/environment.hpp"

namespace eyeray::engine::reference {

// From the unit direction `d`: bilinear between the centres of texels, in longitude and latitude.
Vec3 environment_radiance(const EnvironmentMap& environment, const Vec3& d);

struct EnvironmentSample {
  Vec3 d;          // unit
  double density;  // by solid angle
};
// `u`: two multiples of 2^-24 in [0, 1). There must be light.
EnvironmentSample sample_environment(const EnvironmentMap& environment, const Vec2& u);
// The density, per solid angle, with which sample_environment chooses `d`.
double environment_density(const EnvironmentMap& environment, const Vec3& d);

}  // namespace eyeray::engine::reference
