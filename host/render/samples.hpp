// Shader results as the host's samples.
#pragma once

#include "core/pixel.hpp"
#include "records/records.hpp"

namespace eyeray {

inline PixelSample to_sample(const shader::SampleResult& result) {
  return {Vec3(result.color), result.counts.x, result.counts.y, result.counts.z};
}

// `eye`: the origin of the shaders' world.
FirstHit to_first_hit(const shader::HitResult& result, const Vec3& eye);

}  // namespace eyeray
