#pragma once

#include "host/scene/bounds.hpp"

namespace eyeray::engine {

struct Scene;

// Whether a box has an end on all sides. An empty one has none.
bool is_finite(const Bounds& box);
// A box around all shapes that have an end; empty where there is none.
Bounds extent(const Scene& scene);

}  // namespace eyeray::engine
