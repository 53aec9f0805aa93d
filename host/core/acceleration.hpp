#pragma once

namespace eyeray::engine {

// How an executor finds hits; which hits they are does not depend on it.
enum class Acceleration {
  automatic,    // a BVH, unless there is next to nothing to leave out
  bvh,          // a BVH over all that has bounds
  brute_force,  // every ray is tested against every primitive
};

}  // namespace eyeray::engine
