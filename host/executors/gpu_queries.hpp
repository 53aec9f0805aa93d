// Rays traced on a device, by the kernels that suit them.
#pragma once

#include <memory>
#include <optional>

#include "host/executors/scene_kernels.hpp"
#include "host/executors/trace_plan.hpp"
#include "host/executors/workgroups.hpp"
#include "host/gpu/dispatch_size.hpp"
#include "host/scene/query.hpp"

namespace eyeray::engine::executors {

class GpuQueries {
 public:
  // `eye`: the origin of the shaders' world. Device and kernels must outlive it.
  GpuQueries(gpu::Device& device, SceneKernels& kernels, const TracePlan& plan, const Workgroups& workgroups,
             const Vec3& eye)
      : device_(device), kernels_(kernels), plan_(plan), workgroups_(workgroups), eye_(eye) {}

  // Executor::query.
  double ask(const QueryBatch& batch, std::span<QueryHit> hits);
  // Makes the kernels that `ask` would make when they are first needed.
  void make_kernels();

 private:
  struct TraceKernel {
    std::shared_ptr<gpu::Kernel> kernel;
    std::optional<gpu::DispatchSize> size;
  };

  TraceKernel& kernel(Rays how, bool any);
  double query_some(gpu::Kernel& kernel, Rays how, std::span<const Query> rays, std::span<QueryHit> hits);

  gpu::Device& device_;
  SceneKernels& kernels_;
  TracePlan plan_;
  Workgroups workgroups_;
  Vec3 eye_;
  std::optional<gpu::Buffer> output_;
  TraceKernel made_[2][3];  // first index: whether any hit suffices; second: Rays
};

}  // namespace eyeray::engine::executors
