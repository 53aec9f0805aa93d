// The executors, each behind its maker.
#pragma once

#include "host/executors/executor.hpp"
#include "host/reference/renderer.hpp"

namespace eyeray::engine::executors {

// The twin can report its samples' decisions, too.
class Twin : public Executor {
 public:
  // The decisions of that sample's random path, event by event (shaders/integrators/trail.glsl). May be
  // called from many threads at once.
  virtual std::vector<uint32_t> events(int x, int y, uint32_t index) const = 0;
  // The ways of the photons of sample `index`, if the scene's integrator emits photons.
  virtual std::vector<PhotonWay> photon_ways(uint32_t index) = 0;
};

std::unique_ptr<Executor> make_gpu_executor(const Scene& scene, const ExecutorOptions& options);
std::unique_ptr<Twin> make_twin_executor(const Scene& scene, const ExecutorOptions& options);
std::unique_ptr<Executor> make_reference_executor(const Scene& scene, const ExecutorOptions& options);
// The reference executor with a shared renderer, whose BVHs are built once.
std::unique_ptr<Executor> make_reference_executor(std::shared_ptr<const reference::Renderer> renderer);

}  // namespace eyeray::engine::executors
