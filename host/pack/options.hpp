// What may be chosen about the BVH; which hits are found does not depend on it.
#pragma once

#include <memory>

#include "host/core/acceleration.hpp"

namespace eyeray::engine::bvh {
class BvhHistory;  // bvh/history.hpp
}

namespace eyeray::engine::pack {

struct PackOptions {
  Acceleration acceleration = Acceleration::automatic;
  // Spatial splits (bvh/bvh.hpp), where no primitive lets part of a shadow ray through.
  bool split = false;
  // Where scenes come one after the other: what BVHs are refitted from. Null: each is built.
  std::shared_ptr<bvh::BvhHistory> history = nullptr;
};

}  // namespace eyeray::engine::pack
