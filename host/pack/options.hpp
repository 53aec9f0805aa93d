// Options of the BVH. The hits do not depend on them.
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
  // For scenes that come one after the other: the BVHs of the scene before, which are refitted. Null: each
  // BVH is built.
  std::shared_ptr<bvh::BvhHistory> history = nullptr;

  bool operator==(const PackOptions&) const = default;
};

}  // namespace eyeray::engine::pack
