// Every kind of camera; see shapes/registry.h.
#ifndef CAMERAS
#define CAMERAS(X)    \
  X(perspective, 0u) \
  X(orthographic, 1u)
#endif
