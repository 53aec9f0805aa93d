// What may be chosen about how hits are found; which hits are found does not depend on any of it.
#pragma once

#include <string>

#include "core/acceleration.hpp"

namespace eyeray {

struct PackOptions {
  Acceleration acceleration = Acceleration::automatic;
  bool split =
      false;  // spatial splits (accel/tree.hpp), where no primitive lets part of a shadow ray through
};

// The kernels' profile (render/profile.hpp); an empty choice is the profile's.
struct ProfileOptions {
  std::string profile = "auto";  // auto: by the device | cpu | gpu | small: for slow compilers
  std::string loads;             // texels | storage
  std::string stack;             // shift | array
  std::string rays;              // packets: trace rays that run side by side together | lanes: each alone
  std::string scattered;         // rays that part: wide (four lanes a ray) | lanes | packets
};

}  // namespace eyeray
