// Every kind of material; see shapes/registry.h.
#ifndef MATERIALS
#define MATERIALS(X) \
  X(phong, 0u)       \
  X(mirror, 1u)      \
  X(dielectric, 2u)  \
  X(diffuse, 3u)     \
  X(conductor, 4u)   \
  X(plastic, 5u)     \
  X(principled, 6u)
#endif
