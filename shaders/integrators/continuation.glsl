// A path while it is traced, and the ways in which it may go on. Integrators make these; they never trace.
#ifndef CONTINUATION_GLSL
#define CONTINUATION_GLSL
#include "geometry/ray.glsl"
#include "integrators/trail.glsl"

SHADER_BEGIN

struct Path {
  vec3 o;
  vec3 d;
  vec3 throughput;  // the share of its radiance that arrives in the pixel
  uint depth;       // reflections and refractions so far
  uint media;       // that it is in (materials/media.glsl)
#if RANDOM_WALK
  float density;  // by solid angle, that its direction was chosen with; 0 from the eye, a mirror or glass, which leave no choice
  vec3 normal;    // where it chose that, by which it asks for lights; 0 where light may come from either side
  uint pixel;     // of the picture, and which of its samples: what its random numbers go by
  uint index;
#if HAS_PANES
  vec3 from;        // where its last vertex is, or the eye: panes that it passes straight are none
  uint panes;       // passed since then, …
  uint past_panes;  // … and before
#endif
#endif
#if RAY_KINDS
  bool refracted;  // its last ray, else reflected
#endif
};

// How a path goes on from where it hit something: not, in one way, or in two of which one waits.
struct Continuations {
  uint count;
  Path next;
  Path waiting;
#if RANDOM_WALK
  uint way;  // by which lobe, and whether THROUGH the surface
#endif
#if RAY_KINDS
  bool total_reflection;
  bool cut_off;  // by max_depth
#endif
};

Continuations no_continuation(Path path) {
  Continuations none;
  none.count = 0u;
  none.next = path;
  none.waiting = path;
#if RANDOM_WALK
  none.way = 0u;
#endif
#if RAY_KINDS
  none.total_reflection = false;
  none.cut_off = false;
#endif
  return none;
}

SHADER_END
#endif
