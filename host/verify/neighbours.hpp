// The reference around a pixel, as gates B and C ask for it.
#pragma once

#include "host/compare/explain.hpp"
#include "host/executors/executors.hpp"
#include "host/reference/renderer.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::verify {

// `renderer` is that of `scene`; both must outlive the result.
compare::Reference neighbours(const Scene& scene, const reference::Renderer& renderer);

// The same of single samples, for gate D. `twin` must outlive it too; null: nobody knows the shaders' paths.
compare::PathReference path_neighbours(const Scene& scene, const reference::Renderer& renderer,
                                       const executors::Twin* twin);

}  // namespace eyeray::engine::verify
