// The host's float64 vocabulary. Float32 exists on the host only in packed records and in the twin.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace eyeray::engine {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Vec4 = glm::dvec4;
using Mat4 = glm::dmat4;  // column-major, acts on column vectors: p' = M * p

// A half-line: P(t) = o + t·d, t > 0. d need not be unit.
struct Ray {
  Vec3 o;
  Vec3 d;
  uint32_t alpha_key = 0;  // decides which blended surfaces it hits (reference/rng.hpp)
};

}  // namespace eyeray::engine
