// Rays that are asked about alone, without a picture.
#pragma once

#include <cstdint>

#include "core/vec.hpp"

namespace eyeray {

// In world space.
struct Query {
  Vec3 o;
  Vec3 d;                 // unit
  double t_max = 3.0e38;  // only hits nearer than this count
};

struct QueryHit {
  double t = 0;            // infinity where nothing is hit
  int64_t primitive = -1;  // as Scene counts them; −1 where nothing is hit
};

enum class QueryKind {
  nearest,  // the nearest hit
  any,      // whether anything opaque is hit: t is 0 then, else infinity; no primitive
};

}  // namespace eyeray
