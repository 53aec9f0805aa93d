// Shading normals that a material bends.
#pragma once

#include "host/scene/material.hpp"
#include "host/scene/shape.hpp"

namespace eyeray::engine::reference {

// Bends the shading normal of `point`, which is on the side of its geometric one, as the material does where
// a ray in direction d hits. It bends by its normal map, then by its bumps (Blinn: Simulation of Wrinkled
// Surfaces, SIGGRAPH 1978), then so far back that the mirrored view is above the surface (Keller et al.: The
// Iray Light Transport Simulation and Rendering System, 2017, appendix). A coat has the normal before that
// bending, bent by the coat's own map.
void bend_normals(const Material& material, SurfacePoint& point, const Vec3& d);

}  // namespace eyeray::engine::reference
