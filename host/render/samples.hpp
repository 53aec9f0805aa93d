// Shader results as the host's samples.
#pragma once

#include "core/pixel.hpp"
#include "records/packer.hpp"
#include "render/executor.hpp"

namespace eyeray {

// Error (timed_out) where the flags say that a formula's loops did not end; so do the three below.
void check_ended(uint32_t flags);

inline PixelSample to_sample(const shader::SampleResult& result) {
  check_ended(result.counts.z);
  return {Vec3(result.color), result.counts.x, result.counts.y, result.counts.z};
}

// A ray of the shaders' world, and what it hits.
shader::QueryRay to_query_ray(const Query& ray, const Vec3& eye);
QueryHit to_query_hit(const shader::QueryHit& result);

// `eye`: the origin of the shaders' world.
FirstHit to_first_hit(const shader::HitResult& result, const Vec3& eye);

}  // namespace eyeray
