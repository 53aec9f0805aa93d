// The reference around a pixel, for gates B and C.
#pragma once

#include "host/compare/explain.hpp"
#include "host/executors/executors.hpp"
#include "host/reference/renderer.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::verify {

// `renderer` renders `scene`; both must outlive the result.
compare::Reference neighbours(const Scene& scene, const reference::Renderer& renderer);

// The reference around single samples of a pixel, for gate D. `twin` must outlive the result too. If it is
// null, the shaders' paths are unknown.
compare::PathReference path_neighbours(const Scene& scene, const reference::Renderer& renderer,
                                       const executors::Twin* twin);

}  // namespace eyeray::engine::verify
