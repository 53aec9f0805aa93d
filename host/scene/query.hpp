// Rays that are traced alone, without a picture.
#pragma once

#include <cstdint>
#include <span>

#include "host/core/vec.hpp"

namespace eyeray::engine {

// A ray in world space.
struct Query {
  Vec3 o;
  Vec3 d;                 // unit
  double t_max = 3.0e38;  // only hits nearer than this count
};

enum class QueryKind {
  nearest,  // the nearest hit
  // Occlusion: t is 0 if the ray hits anything opaque, or enough transparent surfaces to block it; else
  // infinity. No primitive is returned.
  any,
};

// Rays that are traced together.
struct QueryBatch {
  std::span<const Query> rays;
  QueryKind kind = QueryKind::nearest;
  bool coherent = false;  // whether neighbouring rays take nearly the same way: may be faster, changes no hit
};

struct QueryHit {
  double t = 0;            // infinity where nothing is hit
  int64_t primitive = -1;  // as Scene counts them; −1 where nothing is hit
  uint32_t flags = 0;      // SampleFlag bits (core/pixel.hpp); 0 when nothing went wrong
};

}  // namespace eyeray::engine
