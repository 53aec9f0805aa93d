// Every lobe of a BSDF; see shapes/registry.h. Of each, bsdf/NAME.glsl has
//   vec3 NAME_albedo(Bsdf bsdf)                                            about how much light it sends towards the viewer
//   LobeValue NAME_value(Bsdf bsdf, Directions at)
//   vec3 NAME_direction(Bsdf bsdf, vec3 o, vec2 u, float part)             by that density; part: a third random number
// and host/reference/bsdf.cpp the same in float64. `coated`: whether a coat lies above it.
#ifndef LOBES
#define LOBES(X)            \
  X(diffuse, 0u, true)      \
  X(glossy, 1u, true)       \
  X(multiple, 2u, true)     \
  X(coat, 3u, false)        \
  X(rough_glass, 4u, false)
#endif
