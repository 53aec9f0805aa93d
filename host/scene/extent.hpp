#pragma once

#include "host/scene/bounds.hpp"

namespace eyeray::engine {

struct Scene;

// True if the box is bounded on all sides. An empty box is not.
bool is_finite(const Bounds& box);
// A box around all bounded shapes; empty if there is none.
Bounds extent(const Scene& scene);

}  // namespace eyeray::engine
