// Shading normals that a material bends.
#pragma once

#include "host/scene/material.hpp"
#include "host/scene/shape.hpp"

namespace eyeray::reference {

// The shading normal of `point`, on the side of its geometric one, as the material bends it where a ray in
// direction d hits: by its normal map, then by its bumps (Blinn: Simulation of Wrinkled Surfaces, SIGGRAPH
// 1978), and so far back that the mirrored view is above the surface (Keller et al.: The Iray Light Transport
// Simulation and Rendering System, 2017, appendix).
Vec3 bent_normal(const Material& material, const SurfacePoint& point, const Vec3& d);

}  // namespace eyeray::reference
