// Every integrator; see shapes/rows.h. A row states to which lights the integrator casts shadow rays where a path hits something, and in
// how many ways at most the path goes on from there.
#ifndef INTEGRATORS
#define INTEGRATORS(X)           \
  X(raycast, 0u, no_light, 0u)    \
  X(whitted, 1u, each_light, 2u)  \
  X(path, 2u, one_light, 1u)      \
  X(sppm, 3u, one_light, 1u)
#endif
