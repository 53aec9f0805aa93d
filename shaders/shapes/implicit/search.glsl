// Common definitions of the march along a formula (shapes/implicit/lipschitz_march.glsl) and the shape.
#ifndef IMPLICIT_GLSL
#define IMPLICIT_GLSL
#include "geometry/cube.glsl"
#include "math/dual.glsl"
#include "shapes/implicit/bound_march.glsl"
#include "math/formula.glsl"

SHADER_BEGIN

// f ≤ 0 in a box of the user's space, which is the cube from −1 to 1 of object space.
struct Implicit {
  vec3 center;  // center of the box
  vec3 extent;  // half its sides
  float lipschitz;
  uint formula;
  bool open;
};

// The results of a march.
#define IMPLICIT_NOTHING 0.0f
#define IMPLICIT_ENTRY 1.0f  // the cube's face where the ray comes in, a cap
#define IMPLICIT_EXIT 2.0f   // … and goes out
#define IMPLICIT_ITSELF 3.0f
#define IMPLICIT_ITERATION_LIMIT 4.0f

// The t at which the world's ray crosses the surface, s along its ObjectRay, having crossed it at `before` last: always a later one, so
// that whoever counts crossings misses none.
float crossing_t(ObjectRay r, float s, float before) { return maximum(r.t + s, before + (2.0f * EPSILON * abs(before) + 1.0e-37f)); }

// Lengths in the cube.
#define IMPLICIT_STEPS 4096u
#define IMPLICIT_REFINEMENTS 40u
#define IMPLICIT_CROSSINGS 64u  // that are passed in CSG objects
#define IMPLICIT_LEAST_STEP 1.0e-5f
#define IMPLICIT_MOST_LEAST 32.0f   // the least step grows to at most so many of the shortest
#define IMPLICIT_RELAXED 1.9f       // below 2, where the free ways would just touch
#define IMPLICIT_MOST_STRETCH 3.0f  // the most by which a free way is stretched
#define IMPLICIT_WIDTH 1.2e-7f
#define IMPLICIT_DIFFERENCE 0.00390625f
#define IMPLICIT_PIECES 4096u
#define IMPLICIT_FINEST 2.5e-7f
#define IMPLICIT_MOST_RAY_OFFSET 64.0f
#define IMPLICIT_STRAYS 8u
#define IMPLICIT_COARSE 4.0f

SHADER_END
#endif
