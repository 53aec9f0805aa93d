// Every kind of light; see shapes/rows.h.
#ifndef LIGHTS
#define LIGHTS(X) \
  X(point, 0u)       \
  X(directional, 1u) \
  X(spot, 2u)
#endif
