// Batches of rays as a renderer traces them: from the camera, to the light, and bounced.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "host/scene/query.hpp"
#include "host/scene/scene.hpp"

namespace eyeray::engine::bench {

struct Batch {
  std::string name;
  QueryKind kind = QueryKind::nearest;
  bool coherent = false;  // whether neighbouring rays take nearly the same way
  std::vector<Query> rays;
};

// The rays through the centres of the pixels of a width × height picture, in blocks of 8 × 8 pixels.
Batch primary_batch(const Scene& scene, int width, int height);

// A point where a ray hits a scene, on the side that the ray came from. It is off the surface by about 2⁻¹⁶
// of the coordinates, so that a float32 ray that leaves it does not hit it again.
struct SurfacePosition {
  uint32_t ray;
  Vec3 position;
  Vec3 normal;  // unit, geometric, towards where the ray came from
};
// `hits` are those of `rays`; a hit that float64 does not confirm is left out.
std::vector<SurfacePosition> surface_positions(const Scene& scene, std::span<const Query> rays,
                                               std::span<const QueryHit> hits);

// A ray from each surface position that faces the scene's first light to that light; empty without a light.
Batch shadow_batch(const Scene& scene, std::span<const SurfacePosition> surface_positions);

// A ray from each surface position, in a random direction whose density is its cosine to the normal.
Batch bounce_batch(std::span<const SurfacePosition> surface_positions, uint32_t seed);

}  // namespace eyeray::engine::bench
