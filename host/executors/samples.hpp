// Shader results as the host's samples.
#pragma once

#include "host/core/pixel.hpp"
#include "host/executors/executor.hpp"
#include "host/records/packer.hpp"

namespace eyeray::engine::executors {

// Throws Error (timed_out) if the flags show that a formula's loops did not end. to_auxiliary, to_query_hit
// and to_first_hit call it.
void check_ended(uint32_t flags);

// `ray_kinds`: whether the kernel counted reflected and refracted rays (records.h, SampleResult).
inline PixelSample to_sample(const shader::SampleResult& result, bool ray_kinds) {
  // In a kernel without a user's shaders, FLAG_ENDLESS_LOOP adds nothing to FLAG_LOOP_BUDGET.
  PixelSample sample{Vec3(result.color), result.rays, result.hits, result.flags & ~FLAG_ENDLESS_LOOP};
  if (ray_kinds) {
    sample.flags &= (1u << REFRACTED_SHIFT) - 1;
    sample.refracted = refracted_of(result);
    sample.reflected = reflected_of(result);
    sample.total_reflections = total_reflections_of(result);
    sample.cut_off = (sample.flags & FLAG_CUT_OFF) != 0;
    sample.flags &= ~FLAG_CUT_OFF;
  }
  if (sample.flags & FLAG_BACKGROUND) {
    sample.flags &= ~FLAG_BACKGROUND;
    sample.background = double(background_of(result)) / WHOLE_BACKGROUND;
    sample.hits &= (1u << HITS_BITS) - 1;
  }
  sample.trail = result.trail;
  check_ended(sample.flags);
  return sample;
}

AuxiliarySample to_auxiliary(const shader::AuxiliaryResult& result);

// A ray in the shaders' world, whose origin is `eye`, and the hit of such a ray.
shader::QueryRay to_query_ray(const Query& ray, const Vec3& eye);
QueryHit to_query_hit(const shader::QueryHit& result);

// `eye`: the origin of the shaders' world. `search_cost`: whether the kernel counted the search's cost.
FirstHit to_first_hit(const shader::HitResult& result, const Vec3& eye, bool search_cost);

}  // namespace eyeray::engine::executors
