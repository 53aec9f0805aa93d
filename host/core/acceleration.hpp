#pragma once

namespace eyeray {

// How an executor finds hits; which hits they are does not depend on it.
enum class Acceleration {
  automatic,    // a tree, unless there is next to nothing to leave out
  tree,         // a tree over all that has bounds
  brute_force,  // every ray is tested against every primitive
};

}  // namespace eyeray
