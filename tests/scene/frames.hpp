// Scenes rendered by an executor, and compared as `eyeray verify` compares them.
#pragma once

#include "host/compare/against_reference.hpp"
#include "host/compare/exact.hpp"
#include "host/compare/soundness.hpp"
#include "host/reference/renderer.hpp"
#include "host/render/render.hpp"

namespace eyeray::test {

inline constexpr Backend backends[] = {Backend::gpu, Backend::twin, Backend::reference};
inline constexpr const char* backend_names[] = {"gpu", "twin", "reference"};

inline Rect whole(const Scene& scene) {
  return {0, 0, scene.image.width, scene.image.height};
}

inline Frame render_frame(const Scene& scene, Executor& executor, Rect area) {
  Rendering rendering = render(scene, executor, {area, true, {}});
  return {area,
          std::move(rendering.color),
          std::move(rendering.first_hits),
          std::move(rendering.hits),
          rendering.rays,
          rendering.flagged_pixels,
          rendering.flags};
}

inline Frame render_frame(const Scene& scene, Backend backend, const ExecutorOptions& options = {}) {
  return render_frame(scene, *make_executor(backend, scene, options), whole(scene));
}

// Gates B and C.
inline ReferenceComparison compare_with_reference(const Scene& scene, const Frame& value) {
  const reference::Renderer renderer(scene);
  const Reference probe = [&](int x, int y, const Vec2& shift) {
    Probe result;
    for (int i = 0; i < scene.image.samples; ++i) {
      const PixelSample sample = renderer.sample(x, y, uint32_t(i), shift);
      result.color += sample.color / double(scene.image.samples);
      result.hits_per_sample += double(sample.hits) / scene.image.samples;
    }
    result.first_hit = renderer.first_hit(x, y, shift);
    return result;
  };
  return compare_with_reference(value, render_frame(scene, Backend::reference), probe);
}

}  // namespace eyeray::test
