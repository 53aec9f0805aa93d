// Every integrator; see shapes/registry.h. IntegratorType in scene/scene.hpp has the same order.
#ifndef INTEGRATORS
#define INTEGRATORS(X) \
  X(raycast, 0u)       \
  X(whitted, 1u)
#endif
