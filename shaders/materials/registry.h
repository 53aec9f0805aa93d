// Every kind of material; see shapes/registry.h.
#ifndef MATERIALS
#define MATERIALS(X) \
  X(phong, 0u)       \
  X(mirror, 1u)      \
  X(dielectric, 2u)
#endif
