// Options on how hits are found, and noise is removed. The results do not depend on them.
#pragma once

#include <string>

namespace eyeray::engine::executors {

// A user's choices for the kernels' profile (executors/profile.hpp). Where a choice is empty, the profile
// decides.
struct ProfileOptions {
  std::string profile = "auto";  // auto: by the device | cpu | gpu | small: for slow compilers
  std::string loads;             // texels | storage
  std::string stack;             // shift | array
  std::string rays;              // packets: trace coherent rays together | lanes: trace each alone
  std::string incoherent;        // incoherent rays: cooperative (four lanes a ray) | lanes | packets
  std::string denoise;           // denoises by the device's kernels | by the processor

  bool operator==(const ProfileOptions&) const = default;
};

}  // namespace eyeray::engine::executors
