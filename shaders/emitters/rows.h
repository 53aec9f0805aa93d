// Every kind of surface on which a lit point can choose a point that lights it; see shapes/rows.h. A row states whether such a surface may
// light itself, as the inside of a sphere does.
#ifndef EMITTERS
#define EMITTERS(X)       \
  X(sphere, 0u, true)     \
  X(disk, 1u, false)      \
  X(triangle, 2u, false)  \
  X(parallelogram, 3u, false) \
  X(box, 4u, true)        \
  X(ellipsoid, 5u, true)  \
  X(cylinder, 6u, true)   \
  X(rectangle, 7u, false)
#endif
