// A path while it is traced, and the ways in which it may go on. Integrators make these; they never trace.
#ifndef CONTINUATION_GLSL
#define CONTINUATION_GLSL
#include "geometry/ray.glsl"
#include "integrators/trail.glsl"
#include "math/rng.glsl"

SHADER_BEGIN

// True if queries of a light BVH need the point where a path's direction was chosen: smooth surfaces lift the ray's start off it.
#define KEEPS_POINT (RANDOM_WALK && HAS_LIGHT_BVH && HAS_SMOOTH)

struct Path {
  vec3 o;
  vec3 d;
  vec3 throughput;  // the share of its radiance that arrives in the pixel
  uint depth;       // reflections and refractions so far
  uint media;       // that it is in (materials/media.glsl)
#if RANDOM_WALK
  float density;  // by solid angle, that its direction was chosen with; 0 from the eye, a mirror or glass, which leave no choice
  vec3 normal;    // where it chose that, by which it asks for lights; 0 where light may come from either side
#endif
#if KEEPS_POINT
  vec3 point;  // where it chose that
#endif
#if RANDOM_WALK || HAS_BLEND
  uint pixel;     // pixel of the picture, and which of its samples: selects its random numbers
  uint index;
#endif
#if RANDOM_WALK
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

// The continuations of a path from its hit: none, one, or two of which one waits.
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

// Surfaces that the path has come through or left so far.
uint surfaces_behind(Path path) {
  uint surfaces = path.depth;
#if RANDOM_WALK && HAS_PANES
  surfaces = surfaces + path.panes + path.past_panes;
#endif
  return surfaces;
}

// `ray` with the key of the path's next ray, number 0, or of the i-th shadow ray from there, number 1 + i. Keys along a path are independent of each
// other; those of two ways in which it goes on may be equal, since their light is only added.
Ray with_alpha_key(Ray ray, Frame frame, Path path, uint number) {
#if HAS_BLEND
  uint dimension = ALPHA_KEYS + (surfaces_behind(path) << 16u) + number;
  ray.alpha_key = pcg_hash(path.pixel + pcg_hash(path.index + pcg_hash(dimension + pcg_hash(frame.seed))));
#endif
  return ray;
}

Ray path_ray(Frame frame, Path path) { return with_alpha_key(make_ray(path.o, path.d), frame, path, 0u); }

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
