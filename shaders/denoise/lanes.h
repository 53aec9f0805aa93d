// Lets one function compute one pixel in a kernel, and several pixels side by side in C++, where compilers turn them into vectors. Each of these
// pixels has its own sums in the same order, so the bits are the same.
#ifndef DENOISE_LANES_H
#define DENOISE_LANES_H

#ifdef __cplusplus
#define LANES 16
#define PER_LANE [LANES]
#define LANE [lane]
#define EACH_LANE for (int lane = 0; lane < LANES; ++lane)
#define IN_CALLER [[gnu::always_inline]] inline
#else
#define PER_LANE
#define LANE
#define EACH_LANE
#define IN_CALLER
#endif

#endif
