// Every integrator; see shapes/registry.h. A row says whether the integrator casts shadow rays, one to each light, and whether its paths
// go on where they hit something.
#ifndef INTEGRATORS
#define INTEGRATORS(X)        \
  X(raycast, 0u, false, false) \
  X(whitted, 1u, true, true)
#endif
