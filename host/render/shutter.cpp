#include "host/render/shutter.hpp"

#include <algorithm>
#include <numeric>
#include <type_traits>

namespace eyeray::engine::render {
namespace {

using executors::Executor;

// The least number of samples in a run, if there are enough samples. 4 Sobol' points are well spread, and few
// enough that the 64 samples before adaptive sampling's first judgement show 16 moments.
constexpr int samples_in_run = 4;

// A step, near the golden section of `count`, whose multiples modulo `count` reach all of its numbers, and
// are well spread after any number of steps.
int golden_step(int count) {
  int step = std::max(1, int(0.618034 * count));
  while (std::gcd(step, count) != 1) ++step;
  return step;
}

// Holds one executor at a time: that of the moment requested last.
class Shutter final : public Executor {
 public:
  Shutter(executors::Backend backend, const Scene& scene, executors::ExecutorOptions options)
      : backend_(backend),
        scene_(scene),
        options_(executors::for_frames(std::move(options), scene.image.all_samples() / moments())) {
    show(scene_.animation.frame);
  }

  bool sample(const Grid& grid, uint32_t index, std::span<PixelSample> out,
              std::span<AuxiliarySample> auxiliaries) override {
    show_moment_of(index);
    return timed([&] { return executor_->sample(grid, index, out, auxiliaries); });
  }
  void first_hits(const Rect& tile, std::span<FirstHit> out) override {
    show(scene_.animation.frame);
    timed([&] { return executor_->first_hits(tile, out), true; });
  }
  executors::Probed probe(int x, int y, uint32_t index) override {
    show_moment_of(index);
    return timed([&] { return executor_->probe(x, y, index); });
  }
  double query(const QueryBatch& batch, std::span<QueryHit> hits) override {
    show(scene_.animation.frame);
    return timed([&] { return executor_->query(batch, hits); });
  }

 private:
  int moments() const { return std::min(scene_.animation.shutter_steps, scene_.image.samples); }

  void show_moment_of(uint32_t index) {
    const double moment = moment_of_sample(int(index), scene_.image.samples, moments());
    show(scene_.animation.frame + scene_.animation.shutter * ((moment + 0.5) / moments() - 0.5));
  }

  void show(double frame) {
    if (executor_ && frame == shown_) return;
    executor_.reset();
    gone_ = times_;
    moment_ = std::make_unique<Scene>(scene_.animation.at(frame));
    // The settings that all samples of one picture share.
    moment_->image = scene_.image;
    moment_->render.integrator = scene_.render.integrator;
    moment_->render.max_depth = scene_.render.max_depth;
    moment_->render.min_throughput = scene_.render.min_throughput;
    executor_ = executors::make_executor(backend_, *moment_, options_);
    shown_ = frame;
    take_over();
    options_.gpu.open_device = facts_.device;
  }

  // Does work with the executor, then takes over its facts and times.
  template <typename Work>
  std::invoke_result_t<Work> timed(const Work& work) {
    auto done = work();
    take_over();
    return done;
  }
  void take_over() {
    const double longest = facts_.longest_dispatch;
    facts_ = executor_->facts();
    facts_.longest_dispatch = std::max(facts_.longest_dispatch, longest);
    times_ = gone_;
    for (const auto& [stage, seconds] : executor_->times().stages()) times_.add(stage, seconds);
  }

  executors::Backend backend_;
  const Scene& scene_;
  executors::ExecutorOptions options_;
  StageTimes gone_;  // times of the earlier executors
  double shown_ = 0;
  std::unique_ptr<Scene> moment_;  // the scene of executor_
  std::unique_ptr<Executor> executor_;
};

}  // namespace

int moment_of_sample(int index, int samples, int moments) {
  const int64_t rounds = std::max(1, samples / (samples_in_run * moments));
  const int64_t run = index * rounds * moments / samples;
  return int(run * golden_step(moments) % moments);
}

std::unique_ptr<Executor> make_picture_executor(executors::Backend backend, const Scene& scene,
                                                const executors::ExecutorOptions& options) {
  if (!scene.animation.at) return executors::make_executor(backend, scene, options);
  return std::make_unique<Shutter>(backend, scene, options);
}

}  // namespace eyeray::engine::render
