// A driver's program for a kernel, with the statistics that the driver states about it.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace eyeray::engine::gpu {

struct Statistic {
  std::string name;  // the driver's word: "VGPRs"
  std::variant<bool, int64_t, uint64_t, double> value;
};

// Most drivers make one program of a compute kernel.
struct Executable {
  std::string name;            // the driver's word: "Compute Shader"
  uint32_t subgroup_size = 0;  // lanes
  std::vector<Statistic> statistics;
};

}  // namespace eyeray::engine::gpu
