// The twin: the shaders compiled as C++, float32, uncontracted. Where it differs from the GPU, the driver,
// the compiler, the upload or the packing is at fault; where it differs from the reference, the algorithm or
// its numerics.
#pragma once

#include "host/core/ray_tree.hpp"
#include "host/records/packer.hpp"

namespace eyeray::twin {

// What kernels/render.comp.glsl computes for one pixel of the whole picture. Thread-safe. `recorder`: is
// shown what the shaders PROBE; null: nobody looks.
shader::SampleResult sample(const records::PackedScene& scene, uint32_t x, uint32_t y, uint32_t index,
                            RayRecorder* recorder = nullptr);
shader::HitResult first_hit(const records::PackedScene& scene, uint32_t x, uint32_t y);
// What kernels/query.comp.glsl computes for one ray.
shader::QueryHit query(const records::PackedScene& scene, const shader::QueryRay& ray, bool any);

}  // namespace eyeray::twin
