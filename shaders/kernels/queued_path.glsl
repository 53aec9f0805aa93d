// A path as the kernels of the wavefront hand it on: `paths`, by the place of its pixel in the tile. Only paths that never split wait
// there, and none of those is in a medium.
#ifndef QUEUED_PATH_GLSL
#define QUEUED_PATH_GLSL
#include "integrators/path.glsl"

Path queued_path(uint place) {
  Path path;
  path.o = paths[place].origin;
  path.d = paths[place].direction;
  path.throughput = paths[place].throughput;
  path.depth = dispatch.depth;
  path.media = 0u;
#if RAY_KINDS
  path.refracted = false;
#endif
  return path;
}

#endif
