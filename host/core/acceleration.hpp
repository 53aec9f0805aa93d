#pragma once

namespace eyeray::engine {

// The method by which an executor finds hits. The hits themselves do not depend on it.
enum class Acceleration {
  automatic,    // a BVH, unless there is next to nothing to leave out
  bvh,          // a BVH over all that has bounds
  brute_force,  // every ray is tested against every primitive
};

}  // namespace eyeray::engine
