// A kernel that an executor made, for people who optimise it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/gpu/executable.hpp"

namespace eyeray::engine::executors {

struct MadeKernel {
  std::string name;                          // its entry and its own defines: "query", "render-first-hits"
  std::vector<uint32_t> spirv;               // as the driver gets it
  double build_seconds = 0;                  // gpu::Kernel::build_seconds
  std::vector<gpu::Executable> executables;  // gpu::Kernel::executables
};

}  // namespace eyeray::engine::executors
