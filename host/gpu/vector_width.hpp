// The width of the vectors that Mesa's llvmpipe computes in.
#pragma once

namespace eyeray::gpu {

// To be called once, before a driver is loaded, which reads the environment then. Where `wide`, and where the
// processor has them, llvmpipe is to compute in vectors of 512 bits; a LP_NATIVE_VECTOR_WIDTH that is set
// already stays as it is. Mesa's shader cache does not know the width of what it keeps. So whoever chose a
// width, its kernels are kept in a folder of their own: below $MESA_SHADER_CACHE_DIR, or else below eyeray's
// own cache.
void set_vector_width(bool wide);

}  // namespace eyeray::gpu
