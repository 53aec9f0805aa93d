// Scenes rendered by an executor, and compared as `eyeray verify` compares them.
#pragma once

#include "host/compare/against_reference.hpp"
#include "host/compare/exact.hpp"
#include "host/compare/soundness.hpp"
#include "host/reference/renderer.hpp"
#include "host/render/render.hpp"

namespace eyeray::engine::test {

inline constexpr executors::Backend backends[] = {executors::Backend::gpu, executors::Backend::twin,
                                                  executors::Backend::reference};
inline constexpr const char* backend_names[] = {"gpu", "twin", "reference"};

inline Rect whole(const Scene& scene) {
  return {0, 0, scene.image.width, scene.image.height};
}

inline compare::Frame render_frame(const Scene& scene, executors::Executor& executor, Rect area) {
  render::Rendering rendering = render::render(scene, executor, {area, true, {}});
  return {area,
          std::move(rendering.color),
          std::move(rendering.first_hits),
          std::move(rendering.hits),
          std::move(rendering.rays_traced),
          rendering.rays,
          rendering.flagged_pixels,
          rendering.flags};
}

inline compare::Frame render_frame(const Scene& scene, executors::Backend backend,
                                   const executors::ExecutorOptions& options = {}) {
  return render_frame(scene, *executors::make_executor(backend, scene, options), whole(scene));
}

// Compares by gates B and C.
inline compare::ReferenceComparison compare_with_reference(const Scene& scene, const compare::Frame& value) {
  const reference::Renderer renderer(scene);
  const compare::Reference around = [&](int x, int y, const Vec2& shift, rounding::Coincidence coincidence) {
    compare::Neighbour result;
    result.samples.clear();
    const rounding::Displacement displacement{.coincident = coincidence == rounding::Coincidence::coincident};
    for (int i = 0; i < scene.image.samples; ++i) {
      const PixelSample sample = renderer.sample(x, y, uint32_t(i), shift, displacement);
      result.samples.push_back({sample.color, {double(sample.hits), double(sample.rays)}});
    }
    result.first_hit = renderer.first_hit(x, y, shift, displacement);
    return result;
  };
  return compare::compare_with_reference(value, render_frame(scene, executors::Backend::reference), around);
}

}  // namespace eyeray::engine::test
