// A path as the kernels of the wavefront hand it on: `paths`, by the position of its pixel in the tile. Only paths that never split wait
// there.
#ifndef QUEUED_PATH_GLSL
#define QUEUED_PATH_GLSL
#include "integrators/continuation.glsl"

Path queued_path(uint slot) {
  Path path;
  path.o = paths[slot].origin;
  path.d = paths[slot].direction;
  path.throughput = paths[slot].throughput;
  path.depth = dispatch.depth;
  path.media = paths[slot].media;
#if RANDOM_WALK
  path.density = paths[slot].density;
  path.normal = vec3(0.0f, 0.0f, 0.0f);
#if HAS_LIGHT_BVH
  path.normal = paths[slot].normal;
#endif
#endif
#if KEEPS_POINT
  path.point = paths[slot].point;
#endif
#if RANDOM_WALK || HAS_BLEND
  path.pixel = paths[slot].pixel;
  path.index = dispatch.sample_index;
#endif
#if RAY_KINDS
  path.refracted = false;
#endif
  return path;
}

#ifdef QUEUES_PATHS
void queue_path(uint slot, Path path) {
  paths[slot].origin = path.o;
  paths[slot].direction = path.d;
  paths[slot].throughput = path.throughput;
  paths[slot].media = path.media;
#if RANDOM_WALK
  paths[slot].density = path.density;
#if HAS_LIGHT_BVH
  paths[slot].normal = path.normal;
#endif
#endif
#if KEEPS_POINT
  paths[slot].point = path.point;
#endif
#if RANDOM_WALK || HAS_BLEND
  paths[slot].pixel = path.pixel;
#endif
}
#endif

#endif
