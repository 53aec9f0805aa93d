// The functions that a kernel calls where its device's division and square root are not to be used as they are (host/gpu/kernel_compiler.hpp). glslang
// drops functions that nothing calls, so a variable does.
#ifndef DEVICE_GLSL
#define DEVICE_GLSL
#ifdef EXACT_ARITHMETIC
#include "math/exact.glsl"
float exact_kept = exact_quotient(1.0f, 1.0f) + exact_root(1.0f);
#endif
#ifdef WORST_ARITHMETIC
#include "math/worst.glsl"
float worst_kept = worst_quotient(1.0f, 1.0f) + worst_root(1.0f);
#endif
#endif
