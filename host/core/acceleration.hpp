#pragma once

namespace eyeray::engine {

// The method by which an executor finds hits. The hits themselves do not depend on it.
enum class Acceleration {
  automatic,    // a BVH, unless it could leave out next to nothing
  bvh,          // a BVH over all primitives that have bounds
  brute_force,  // every ray is tested against every primitive
};

}  // namespace eyeray::engine
