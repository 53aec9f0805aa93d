#pragma once

#include "host/scene/bounds.hpp"

namespace eyeray::engine {

struct Scene;

// True if a box ends on all sides. An empty box does not.
bool is_finite(const Bounds& box);
// A box around all shapes that have an end; empty where there is none.
Bounds extent(const Scene& scene);

}  // namespace eyeray::engine
