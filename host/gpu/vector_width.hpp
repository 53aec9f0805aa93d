// The width of the vectors that Mesa's llvmpipe computes in.
#pragma once

#include <string>
#include <string_view>

namespace eyeray::engine::gpu {

// True if llvmpipe can be set to vectors of 512 bits: the processor has them, and LP_NATIVE_VECTOR_WIDTH is
// not set.
bool may_widen_vectors();

// True if a driver of this version makes pictures sooner with vectors of 512 bits: Mesa 22 does. Later ones
// gain nothing from them, and take up to six times as long to compile (docs/experiments/wide-vectors.md).
bool gains_from_wide_vectors(std::string_view driver_version);

// Call this before a driver is loaded, since the driver then reads the environment. If `wide`, and if
// possible, llvmpipe computes in vectors of 512 bits. Mesa's shader cache does not record the vectors' width.
// So kernels of a chosen width, whoever chose it, are cached in a separate folder: below
// $MESA_SHADER_CACHE_DIR, or else below eyeray's own cache.
void set_vector_width(bool wide);

// A warning that Mesa's shader cache is not used, since others could have changed it; "" if it is used.
std::string driver_cache_warning();

}  // namespace eyeray::engine::gpu
