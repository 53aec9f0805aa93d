// Every kind of camera; see shapes/registry.h. CameraType in scene/scene.hpp has the same names and numbers.
#ifndef CAMERAS
#define CAMERAS(X)    \
  X(perspective, 0u) \
  X(orthographic, 1u)
#endif
