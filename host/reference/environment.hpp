// Light from all directions, given by a picture (docs/rendering.md), and the sampling of its directions.
#pragma once

#include "host/scene/environment.hpp"

namespace eyeray::engine::reference {

// The radiance from the unit direction `d`, bilinear between the centres of texels, in longitude and
// latitude.
Vec3 environment_radiance(const EnvironmentMap& environment, const Vec3& d);

struct EnvironmentSample {
  Vec3 d;          // unit
  double density;  // by solid angle
};
// `u`: two multiples of 2^-24 in [0, 1). The environment must not be black.
EnvironmentSample sample_environment(const EnvironmentMap& environment, const Vec2& u);
// The density, per solid angle, with which sample_environment chooses `d`.
double environment_density(const EnvironmentMap& environment, const Vec3& d);

}  // namespace eyeray::engine::reference
