#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "benchmarks/bench/field.hpp"

namespace eyeray::engine::bench {
namespace {

std::string millions(double rays_per_second) {
  return fmt::format("{:.3g}", rays_per_second / 1e6);
}

// "0.88", or "-" where there is nothing to compare with.
std::string ratio(double value) {
  return value > 0 ? fmt::format("{:.2f}", value) : "-";
}

std::string row(const BatchReport& batch, const Timing& timing) {
  const bool compared = timing.kind == ContenderKind::ours;
  return fmt::format("  {:<9} {:<24} {:>8}  {:>6} … {:<6} {:>8} {:>9} {:>9}\n", batch.name, timing.contender,
                     millions(rate(batch, timing)), millions(double(batch.rays) / timing.seconds.max),
                     millions(double(batch.rays) / timing.seconds.min),
                     compared ? ratio(times_as_fast(batch, timing, ContenderKind::single)) : "",
                     compared ? ratio(times_as_fast(batch, timing, ContenderKind::packet)) : "",
                     timing.differing);
}

}  // namespace

std::string to_text(const FieldReport& report) {
  std::string text;
  for (const SceneReport& scene : report) {
    text += fmt::format("{}: {} primitives\n", scene.scene, scene.primitives);
    for (const Build& build : scene.builds) {
      const double each = double(build.bytes) / double(std::max<uint64_t>(1, scene.primitives));
      text += fmt::format("  build     {:<24} {:>8.3g} s{}\n", build.contender, build.seconds,
                          build.bytes > 0 ? fmt::format(", {:.1f} bytes a primitive", each) : "");
    }
    text += fmt::format("  {:<9} {:<24} {:>8}  {:<15} {:>8} {:>9} {:>9}\n", "rays", "", "Mrays/s", "  spread",
                        ": single", ": packets", "differ");
    for (const BatchReport& batch : scene.batches) {
      for (const Timing& timing : batch.timings) {
        if (timing.kind != ContenderKind::packet || &timing == fastest(batch, ContenderKind::packet))
          text += row(batch, timing);
      }
    }
    text += "\n";
  }
  return text;
}

std::string changes(const FieldReport& old, const FieldReport& report) {
  std::string text;
  const auto find = [](const auto& list, auto member, const std::string& name) {
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const auto& each) { return each.*member == name; });
    return found == list.end() ? nullptr : &*found;
  };
  for (const SceneReport& scene : report) {
    const SceneReport* const old_scene = find(old, &SceneReport::scene, scene.scene);
    if (!old_scene) continue;
    for (const Build& build : scene.builds) {
      const Build* const old_build = find(old_scene->builds, &Build::contender, build.contender);
      if (!old_build || !(old_build->seconds > 0)) continue;
      text += fmt::format("{:<24} {:<9} {:<24} {:>8.3g} -> {:<8.3g} {:>+7.1f} %, {} -> {} bytes\n",
                          scene.scene, "build, s", build.contender, old_build->seconds, build.seconds,
                          100 * (build.seconds / old_build->seconds - 1), old_build->bytes, build.bytes);
    }
    for (const BatchReport& batch : scene.batches) {
      const BatchReport* const old_batch = find(old_scene->batches, &BatchReport::name, batch.name);
      if (!old_batch) continue;
      for (const Timing& timing : batch.timings) {
        const Timing* const old_lap = find(old_batch->timings, &Timing::contender, timing.contender);
        if (!old_lap || old_lap->seconds.median <= 0 || old_batch->rays == 0) continue;
        // If the spreads touch, both speeds may be the same.
        const double scale = double(batch.rays) / double(old_batch->rays);
        const bool apart = timing.seconds.min > scale * old_lap->seconds.max ||
                           timing.seconds.max < scale * old_lap->seconds.min;
        const double before = rate(*old_batch, *old_lap), now = rate(batch, timing);
        text += fmt::format("{:<24} {:<9} {:<24} {:>8} -> {:<8} {:>+7.1f} %{}\n", scene.scene, batch.name,
                            timing.contender, millions(before), millions(now), 100 * (now / before - 1),
                            apart ? "" : "  within the spread");
      }
    }
  }
  return text;
}

}  // namespace eyeray::engine::bench
