// What may be chosen about the BVH; which hits are found does not depend on it.
#pragma once

#include "host/core/acceleration.hpp"

namespace eyeray::pack {

struct PackOptions {
  Acceleration acceleration = Acceleration::automatic;
  // Spatial splits (bvh/bvh.hpp), where no primitive lets part of a shadow ray through.
  bool split = false;
};

}  // namespace eyeray::pack
