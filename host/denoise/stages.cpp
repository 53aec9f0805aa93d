#include "host/denoise/stages.hpp"

#include <atomic>
#include <thread>

#include "host/core/error.hpp"
#include "host/denoise/regression.hpp"

namespace eyeray::engine::denoise {
namespace {

constexpr double share_of_average = 0.23;  // its share of the time of both stages, on a processor

// Calls body(x, y) for the first pixel of each tile, and report(share) after those that this thread computes.
template <typename Report, typename Body>
void for_each_tile(const Planes& planes, const Report& report, const Body& body) {
  const int across = (planes.width() + tile_width - 1) / tile_width;
  const int down = (planes.height() + tile_height - 1) / tile_height;
  const std::thread::id caller = std::this_thread::get_id();
  std::atomic<int> done = 0;
  parallel_for(0, across * down, [&](int i) {
    body(i % across * tile_width, i / across * tile_height);
    const int count = ++done;
    if (std::this_thread::get_id() == caller) report(double(count) / (across * down));
  });
}

}  // namespace

void Stages::report(double share) const {
  if (progress_ && !progress_(share)) throw Error(ExitCode::interrupted, "denoising was stopped");
}

void Stages::report_average(double share) const {
  report(share_of_average * share);
}

void Stages::report_fit(double share) const {
  report(share_of_average + (1 - share_of_average) * share);
}

void ProcessorStages::average(const NoisyFeatures& features, Planes& means) {
  const Stopwatch watch;
  const auto report = [&](double share) { report_average(share); };
  for_each_tile(means, report, [&](int x, int y) {
    Distances distances(feature_radius);
    const auto add = [&](const Planes& half, const Planes& other) {
      distances.compute(other, features.variances, feature_variance, features.valid, x, y);
      average_tile(half, distances, x, y, means);
    };
    add(features.halves.first, features.halves.second);
    add(features.halves.second, features.halves.first);
  });
  times_.add("features", watch.seconds());
}

void ProcessorStages::fit(const NoisyColors& colors, Halves& careful, Halves& bold) {
  const Stopwatch watch;
  const auto report = [&](double share) { report_fit(share); };
  for_each_tile(colors.valid, report, [&](int x, int y) {
    Distances distances(window_radius);
    const auto fit = [&](const Planes& half, const Planes& lights, const Planes& variances, Planes& one,
                         Planes& other) {
      distances.compute(lights, variances, colors.least, colors.valid, x, y);
      fit_tile(half, colors.features, distances, careful_strictness, x, y, one);
      fit_tile(half, colors.features, distances, bold_strictness, x, y, other);
    };
    fit(colors.colors.first, colors.lights.second, colors.variances.second, careful.first, bold.first);
    fit(colors.colors.second, colors.lights.first, colors.variances.first, careful.second, bold.second);
  });
  times_.add("fits", watch.seconds());
}

}  // namespace eyeray::engine::denoise
