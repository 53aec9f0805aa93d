// The executors, each behind its maker.
#pragma once

#include "render/executor.hpp"

namespace eyeray {

std::unique_ptr<Executor> make_gpu_executor(const Scene& scene, const ExecutorOptions& options);
std::unique_ptr<Executor> make_twin_executor(const Scene& scene, const ExecutorOptions& options);
std::unique_ptr<Executor> make_reference_executor(const Scene& scene, const ExecutorOptions& options);

}  // namespace eyeray
