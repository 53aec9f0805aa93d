// Every sampler, the `pattern` of a picture; see shapes/registry.h.
#ifndef SAMPLERS
#define SAMPLERS(X) \
  X(regular, 0u)    \
  X(jittered, 1u)
#endif
