// The point at which a surface's textures are sampled.
#pragma once

#include "host/scene/shape.hpp"
#include "host/scene/texture.hpp"

namespace eyeray::engine::reference {

inline TextureContext context_on(const SurfacePoint& point) {
  return {point.uv, point.second ? point.second->uv : point.uv, point.position};
}

}  // namespace eyeray::engine::reference
