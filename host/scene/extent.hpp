#pragma once

#include "host/scene/bounds.hpp"

namespace eyeray {

struct Scene;

// A box around all shapes that have an end; empty where there is none.
Bounds extent(const Scene& scene);

}  // namespace eyeray
