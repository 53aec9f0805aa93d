// A path as the kernels of the wavefront hand it on: `paths`, by the position of its pixel in the tile. Only paths that never split wait
// there.
#ifndef QUEUED_PATH_GLSL
#define QUEUED_PATH_GLSL
#include "integrators/continuation.glsl"

Path queued_path(uint place) {
  Path path;
  path.o = paths[place].origin;
  path.d = paths[place].direction;
  path.throughput = paths[place].throughput;
  path.depth = dispatch.depth;
  path.media = paths[place].media;
#if RANDOM_WALK
  path.density = paths[place].density;
  path.normal = vec3(0.0f, 0.0f, 0.0f);
#if HAS_LIGHT_BVH
  path.normal = paths[place].normal;
#endif
#endif
#if RANDOM_WALK || HAS_BLEND
  path.pixel = paths[place].pixel;
  path.index = dispatch.sample_index;
#endif
#if RAY_KINDS
  path.refracted = false;
#endif
  return path;
}

#ifdef QUEUES_PATHS
void queue_path(uint place, Path path) {
  paths[place].origin = path.o;
  paths[place].direction = path.d;
  paths[place].throughput = path.throughput;
  paths[place].media = path.media;
#if RANDOM_WALK
  paths[place].density = path.density;
#if HAS_LIGHT_BVH
  paths[place].normal = path.normal;
#endif
#endif
#if RANDOM_WALK || HAS_BLEND
  paths[place].pixel = path.pixel;
#endif
}
#endif

#endif
