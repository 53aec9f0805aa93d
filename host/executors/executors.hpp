// The executors, each behind its maker.
#pragma once

#include "host/executors/executor.hpp"
#include "host/reference/renderer.hpp"

namespace eyeray::executors {

std::unique_ptr<Executor> make_gpu_executor(const Scene& scene, const ExecutorOptions& options);
std::unique_ptr<Executor> make_twin_executor(const Scene& scene, const ExecutorOptions& options);
std::unique_ptr<Executor> make_reference_executor(const Scene& scene, const ExecutorOptions& options);
// The same by a renderer that others use too: its BVHs are built once.
std::unique_ptr<Executor> make_reference_executor(std::shared_ptr<const reference::Renderer> renderer);

}  // namespace eyeray::executors
