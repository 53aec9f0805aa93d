// Intersects a ray with a Bézier patch, in float64. Nishita, Sederberg and Kakimoto: Ray Tracing Trimmed
// Rational Surface Patches, SIGGRAPH 1990.
#pragma once

#include <optional>

#include "host/scene/shape.hpp"
#include "host/shapes/bezier_net.hpp"

namespace eyeray::engine::shapes {

// The nearest intersection with t > 0, and its u and v. Borders belong to the patch, and are as wide as
// float64's rounding.
std::optional<Intersection> clip_bezier(const BezierNet& net, const Ray& ray);

}  // namespace eyeray::engine::shapes
