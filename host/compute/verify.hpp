// Verifies a job: on a device and by the emulator, against files, and against another kernel.
#pragma once

#include <filesystem>
#include <optional>

#include "host/compare/report.hpp"
#include "host/compute/run.hpp"

namespace eyeray::engine::compute {

// True if a kernel with this fault may crash a device, or never end on it.
bool is_dangerous(const emulator::Finding& finding);

struct VerifyOptions {
  RunOptions run;
  bool on_device = true;             // run it on the device
  bool emulated = true;              // run it by the emulator: gate S
  uint64_t ulp = 0;                  // gate A allows at least this distance of reals
  std::filesystem::path evidence{};  // the folder for the buffers of a job that fails; empty: none
  bool keep_always = false;          // write them even if no gate fails
};

// Gate A compares the executors' buffers. Gate S has the emulator's findings, and compares its results in two
// orders of work groups. After a finding that could crash or hang a device the device does not run the
// kernel. Gate G compares with files, and gate K with another kernel. The errors of run().
compare::Report verify_job(const Job& job, const VerifyOptions& options);

}  // namespace eyeray::engine::compute
