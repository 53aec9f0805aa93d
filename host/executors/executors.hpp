// The executors, each behind its maker.
#pragma once

#include "host/executors/executor.hpp"
#include "host/reference/renderer.hpp"

namespace eyeray::engine::executors {

// The twin can say what its samples decided, too.
class Twin : public Executor {
 public:
  // What the random path of that sample decides, event by event (shaders/integrators/trail.glsl). From many
  // threads at once.
  virtual std::vector<uint32_t> events(int x, int y, uint32_t index) const = 0;
  // Where the scene's integrator sends out photons: the ways of those of sample `index`.
  virtual std::vector<PhotonWay> photon_ways(uint32_t index) = 0;
};

std::unique_ptr<Executor> make_gpu_executor(const Scene& scene, const ExecutorOptions& options);
std::unique_ptr<Twin> make_twin_executor(const Scene& scene, const ExecutorOptions& options);
std::unique_ptr<Executor> make_reference_executor(const Scene& scene, const ExecutorOptions& options);
// The same by a renderer that others use too: its BVHs are built once.
std::unique_ptr<Executor> make_reference_executor(std::shared_ptr<const reference::Renderer> renderer);

}  // namespace eyeray::engine::executors
