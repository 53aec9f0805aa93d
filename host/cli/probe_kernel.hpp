// eyeray probe for kernels that users bring (docs/kernel-files.md).
#pragma once

#include <string>
#include <vector>

#include "host/executors/executors.hpp"

namespace eyeray::engine::cli {

struct ProbedKernel {
  std::string file;                          // a kernel file, or a kernel
  std::vector<std::string> defines;          // values that replace those of the file
  std::string invocation;                    // "X,Y,Z", "X,Y" or "X"
  std::string follow;                        // a variable, or empty
  std::vector<executors::Backend> backends;  // empty: gpu and emulator
  bool json = false;
};

// Prints the invocation. The errors of compute::load_job and compute::probe; Error (bad_input) for a wrong
// invocation or backend.
ExitCode probe_kernel(const ProbedKernel& kernel, const executors::ExecutorOptions& executor);

}  // namespace eyeray::engine::cli
