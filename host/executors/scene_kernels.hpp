// Kernels made for one scene: the entries, compiled with the scene's scene.glsl, and with its buffers bound.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "host/core/error.hpp"
#include "host/core/raw_vector.hpp"
#include "host/core/stopwatch.hpp"
#include "host/executors/executor.hpp"
#include "host/executors/loop_guard.hpp"
#include "host/executors/open_device.hpp"
#include "host/executors/shader_files.hpp"
#include "host/executors/tunables.hpp"
#include "host/executors/uploaded_scene.hpp"
#include "host/gpu/kernel.hpp"
#include "host/gpu/kernel_compiler.hpp"
#include "host/records/packer.hpp"

namespace eyeray::engine::executors {

// The entries that trace given rays, indexed by Rays.
inline constexpr const char* trace_entries[] = {
    "kernels/query.comp.glsl", "kernels/cooperative/packet.comp.glsl", "kernels/cooperative/bvh4.comp.glsl"};

class SceneKernels {
 public:
  // The parts and tools that kernels are made from. All must outlive the kernels.
  struct Workshop {
    OpenDevice& device;
    StageTimes& times;
    ExecutorFacts& facts;  // gets the kernels' source files, and the bytes of geometry
    gpu::KernelOptions how;
    Tunables* tunables;  // null: none
    // The iterations that all counted loops of a user's shaders may make together in one invocation.
    uint32_t most_iterations;
    bool ray_kinds;  // whether kernels count reflected and refracted rays (records.h, SampleResult)
    bool examines;   // whether to list the kernels among the facts
  };

  SceneKernels(const Workshop& workshop, UploadedScene& scene, ShaderFiles files)
      : workshop_(workshop), scene_(scene), files_(std::move(files)), guard_(workshop.most_iterations) {}

  // Keeps the nodes from which a BVH4 is made with the first kernel that traverses it.
  void make_bvh4_of(RawVector<shader::uvec4> nodes, const shader::Bvh& bvh) {
    binary_nodes_ = std::move(nodes);
    bvh_ = bvh;
  }
  // InputError where the text does not compile.
  std::shared_ptr<gpu::Kernel> make(const std::string& entry, std::string defines = "");
  // The text of an entry and all that it includes.
  gpu::ShaderSource source(const std::string& entry) { return source(entry, false); }
  // Runs a dispatch of these kernels, with the tunables' present values. If it times out, the error names the
  // loops of a user's shaders.
  template <typename Dispatch>
  auto run(const Dispatch& dispatch) {
    if (tunables_ && uploaded_ != choice()) upload_tunables();
    try {
      return dispatch();
    } catch (const Error& error) {
      if (error.code() != ExitCode::timed_out) throw;
      throw guard_.explained(error);
    }
  }
  // Error (timed_out) where the flags of any of these results state that a loop of a user's shaders did not
  // end.
  template <typename Results>
  void check_loops(const Results& results) const {
    if (!guard_.active()) return;
    for (const auto& result : results) guard_.check(result.flags, workshop_.ray_kinds);
  }
  // Tunables::choice. Samples made under another choice are outdated.
  uint64_t choice() const { return workshop_.tunables ? workshop_.tunables->choice() : 0; }

 private:
  gpu::ShaderSource source(const std::string& entry, bool guarded);
  void upload_bvh4();
  void upload_tunables();
  bool moves_tunables() const;

  Workshop workshop_;
  UploadedScene& scene_;
  ShaderFiles files_;
  LoopGuard guard_;
  RawVector<shader::uvec4> binary_nodes_;  // freed once they are collapsed
  shader::Bvh bvh_{};
  uint32_t bvh4_stack_ = 1;  // CollapsedBvh::stack_size
  std::optional<gpu::Buffer> tunables_;
  uint64_t uploaded_ = 0;  // the choice that the buffer has
};

}  // namespace eyeray::engine::executors
