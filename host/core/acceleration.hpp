#pragma once

namespace eyeray {

// How an executor finds what a ray meets. The hits are the same, to the last bit.
enum class Acceleration {
  tree,         // by a tree of boxes
  brute_force,  // by asking every primitive
};

}  // namespace eyeray
