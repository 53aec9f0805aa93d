#pragma once

#include <string>

#include "host/scene/scene.hpp"

namespace eyeray::engine::contenders {

// The scene in POV-Ray 3.7's language, for a picture of width × height: geometry, camera, lights, depth and
// the scattering of phong and mirror materials are the same. Exceptions: a texture becomes its
// colour at uv 0, and a coloured highlight becomes white, of its mean. Glass stays glass, but does not nest.
// Error (bad_input) for a shape that POV-Ray has no primitive for, and for cutouts.
std::string povray_scene(const Scene& scene, int width, int height);
// The same scene, also lit by radiosity: the light that its surfaces emit and scatter onto each other.
// Error (bad_input) for an environment as well.
std::string povray_radiosity(const Scene& scene, int width, int height);

}  // namespace eyeray::engine::contenders
