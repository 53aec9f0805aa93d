// Every kind of surface that a point can choose a place on to be lit from; see shapes/registry.h.
#ifndef EMITTERS
#define EMITTERS(X) \
  X(sphere, 0u)     \
  X(disk, 1u)       \
  X(triangle, 2u)   \
  X(parallelogram, 3u)
#endif
