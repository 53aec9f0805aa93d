// Shading normals that a material bends.
#pragma once

#include "host/scene/material.hpp"
#include "host/scene/shape.hpp"

namespace eyeray::engine::reference {

// Bends the shading normal of `point` as the material sets it, for a ray that hits in direction d. At first
// this normal is on the side of the geometric one. The normal map bends it, then the bump map (Blinn:
// Simulation of Wrinkled Surfaces, SIGGRAPH 1978). Then it is bent back until the mirrored view is above the
// surface (Keller et al.: The Iray Light Transport Simulation and Rendering System, 2017, appendix). A coat's
// normal starts from the unbent shading normal, and only the coat's own map bends it before that last step.
// Sets the direction along which microfacets are wider, too, perpendicular to the bent normal.
void bend_normals(const Material& material, SurfacePoint& point, const Vec3& d);

}  // namespace eyeray::engine::reference
