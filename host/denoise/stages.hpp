// The stages of denoising that take long. The processor computes them, or a device's kernels.
#pragma once

#include <functional>
#include <utility>

#include "host/core/stopwatch.hpp"
#include "host/denoise/planes.hpp"

namespace eyeray::engine::denoise {

constexpr int feature_count = 6;           // albedo and normal
constexpr int feature_radius = 5;          // radius of the window in which features lose their noise
constexpr float feature_variance = 1e-4f;  // added to the variance of features, which are from −1 to 1
// The weight of differences in two fits: one keeps details, and one averages more.
constexpr float careful_strictness = 2.5f, bold_strictness = 0.4f;

// All planes are extended (Planes::extend), and `valid` is 1 for pixels that count, else 0.
struct NoisyFeatures {
  const Halves& halves;
  const Planes& variances;
  const Planes& valid;
};
struct NoisyColors {
  const Halves& colors;
  const Planes& features;  // without noise
  // The values by which pixels are compared, their variances, and the least that is added to these.
  const Halves& lights;
  const Halves& variances;
  float least;
  const Planes& valid;
};

class Stages {
 public:
  virtual ~Stages() = default;
  // Called on the caller's thread after some tiles, with the share of both stages that is done. Returns
  // whether to go on: if not, the stage ends with an Error (interrupted).
  using Progress = std::function<bool(double share)>;
  void report_to(Progress progress) { progress_ = std::move(progress); }
  // Writes the mean of both halves to `means`, which are 0 before. Each half is averaged in a window, with
  // weights from the other one.
  virtual void average(const NoisyFeatures& features, Planes& means) = 0;
  // Fits each half of the colours in windows (fit_tile), with weights from the other half.
  virtual void fit(const NoisyColors& colors, Halves& careful, Halves& bold) = 0;
  // Seconds spent so far, part by part.
  const StageTimes& times() const { return times_; }

 protected:
  // To be called with the share of a stage that is done.
  void report_average(double share) const;
  void report_fit(double share) const;

  StageTimes times_;

 private:
  void report(double share) const;

  Progress progress_;  // may be empty
};

// The stages on the processor, by all threads, in vectors.
class ProcessorStages final : public Stages {
 public:
  void average(const NoisyFeatures& features, Planes& means) override;
  void fit(const NoisyColors& colors, Halves& careful, Halves& bold) override;
};

}  // namespace eyeray::engine::denoise
