// Compiles a function for processors with wider vectors too. Private to the denoiser.
#pragma once

// The program chooses by its processor when it starts. All choices have the same bits if no sum is split
// among lanes, since floats are never contracted. Only GCC does it: sanitizers are Clang's, and run before
// the choice.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define IN_WIDE_VECTORS __attribute__((target_clones("default", "avx2", "arch=skylake-avx512")))
#else
#define IN_WIDE_VECTORS
#endif
