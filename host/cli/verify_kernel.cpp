#include "host/cli/verify_kernel.hpp"

#include <algorithm>

#include "host/compute/verify.hpp"
#include "host/core/standard_streams.hpp"
#include "host/executors/open_device.hpp"

namespace eyeray::engine::cli {

compare::Report verify_kernel(const KernelSubject& subject, const verify::Options& options) {
  const auto runs_on = [&](executors::Backend backend) {
    return !subject.backends_given || std::ranges::find(options.backends, backend) != options.backends.end();
  };
  const executors::GpuOptions& gpu = options.executor.gpu;
  const compute::VerifyOptions how{.run = {executors::device_options(gpu, false), gpu.fast_math},
                                   .on_device = runs_on(executors::Backend::gpu),
                                   .emulated = runs_on(executors::Backend::emulator),
                                   .ulp = uint64_t(options.ulp),
                                   .evidence = subject.evidence,
                                   .keep_always = subject.keep_always};
  if (!how.on_device && !how.emulated)
    throw Error(ExitCode::bad_input, "--backends twin: a kernel runs on gpu and emulator");
  const compute::Job job = compute::load_job(subject.file, subject.defines);
  for (const Diagnostic& warning : job.warnings) print_lines(stderr, "{}\n", format_diagnostic(warning));
  return compute::verify_job(job, how);
}

}  // namespace eyeray::engine::cli
