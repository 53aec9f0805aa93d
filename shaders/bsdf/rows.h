// Every lobe of a BSDF; see shapes/rows.h. bsdf/NAME.glsl has for each:
//   vec3 NAME_albedo(Bsdf bsdf)                                            about how much light it sends towards the viewer.
//   LobeValue NAME_value(Bsdf bsdf, Directions at)
//   vec3 NAME_direction(Bsdf bsdf, vec3 o, vec2 u, float part)             by that density; part: a third random number.
// The same in float64 is in host/reference/bsdf.cpp. `layers`: how many may lie above it (bsdf/layers.glsl).
#ifndef LOBES
#define LOBES(X)            \
  X(diffuse, 0u, 2u)      \
  X(glossy, 1u, 2u)       \
  X(multiple, 2u, 2u)     \
  X(coat, 3u, 0u)         \
  X(rough_glass, 4u, 2u)  \
  X(sheen, 5u, 1u)        \
  X(thin, 6u, 2u)         \
  X(translucent, 7u, 2u)
#endif
