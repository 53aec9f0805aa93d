// All rays are parallel.
#ifndef ORTHOGRAPHIC_GLSL
#define ORTHOGRAPHIC_GLSL
#include "geometry/ray.glsl"
#include "records.h"

SHADER_BEGIN

// across: from the eye to where the ray starts.
Ray orthographic_ray(Frame frame, vec3 across, vec2 lens) { return make_ray(across, frame.forward); }

SHADER_END
#endif
