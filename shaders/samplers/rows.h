// Every sampler, the `pattern` of a picture; see shapes/rows.h. A row states how many samples a pixel may have: n × n, or any number.
#ifndef SAMPLERS
#define SAMPLERS(X)      \
  X(regular, 0u, square)  \
  X(jittered, 1u, square) \
  X(random, 2u, any)      \
  X(sobol, 3u, any)
#endif
