#pragma once

#include "benchmarks/bench/field.hpp"

namespace eyeray::engine::bench {

struct FieldOptions {
  int width = 1024;  // width of the picture whose camera rays are traced
  int height = 1024;
  int runs = 5;
  uint32_t seed = 0;  // seed of the bounced rays
};

// Builds Embree's BVH, makes the three batches, and races `ours` on them beside Embree by single rays and
// packets. Embree's single rays are the first contender: the hits of all others are compared with theirs.
SceneReport run_field(const std::string& name, const std::string& family, const Scene& scene,
                      const FieldOptions& options, std::span<const Contender> ours);

}  // namespace eyeray::engine::bench
