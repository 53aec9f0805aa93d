// Every kind of camera; see shapes/rows.h. A row states where in the picture the camera sees anything: all over the picture, in a
// circle, whose radius, as `across` has it, is the length of `forward`, or where NAME_sees returns true.
#ifndef CAMERAS
#define CAMERAS(X)               \
  X(perspective, 0u, picture)    \
  X(orthographic, 1u, picture)   \
  X(fisheye, 2u, circle)         \
  X(panorama, 3u, picture)       \
  X(cylindrical, 4u, picture)    \
  X(formula, 5u, itself)
#endif
