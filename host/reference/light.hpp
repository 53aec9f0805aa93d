#pragma once

#include "host/scene/scene.hpp"

namespace eyeray::reference {

// A light as a point sees it.
struct Illumination {
  Vec3 l;           // unit, towards the light
  Vec3 color;       // what arrives, were nothing between
  double distance;  // of a point light; infinite for a directional one
};

Illumination illuminate(const Light& light, const Vec3& point);

}  // namespace eyeray::reference
