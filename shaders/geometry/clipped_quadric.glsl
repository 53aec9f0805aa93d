// Intersects a ray with a quadric that is cut to a convex piece of space.
#ifndef CLIPPED_QUADRIC_GLSL
#define CLIPPED_QUADRIC_GLSL
#include "geometry/ray.glsl"

SHADER_BEGIN

#define PART_QUADRIC 0.0f
#define PART_ENTRY 1.0f
#define PART_EXIT 2.0f

// (−b − root) / a and (−b + root) / a, without cancellation. `root`: √(b² − ac).
vec2 quadratic_roots(float a, float b, float c, float root) {
  float q = b < 0.0f ? root - b : -root - b;
  float one = q / a;
  float other = q == 0.0f ? 0.0f : c / q;
  return b < 0.0f ? vec2(other, one) : vec2(one, other);
}

// The first s with t + s > 0 at which the ray hits the boundary of a·s² + 2b·s + c ≤ 0 between s = enter and s = leave. The hit part is
// the quadric, or the piece's own boundary where the ray enters or leaves it. `open`: only the quadric. T_MISS if there is none. Where the
// quadric and the piece's boundary intersect, both come from the same four numbers, so that no ray passes between them.
// `equation`: a, b, c. `nearest_equation`: the same from s = `nearest_at`, the ray's point nearest to the centre. The discriminant is that
// of either; there the products whose difference it is are smallest, so that a ray that grazes is hit where it should be. A root is from
// that of the two points which is closer to it. Where a ray runs along a cone and past its apex, a root seen from afar has no digits left.
// The sign of a root near s = 0 keeps a ray that leaves from coming back.
float clipped_quadric(Ray ray, float t, vec3 equation, float nearest_at, vec3 nearest_equation, float enter, float leave, bool open, OUT(float) part) {
  float a = equation.x;
  float b = equation.y;
  float c = equation.z;

  // Inside the quadric: between its roots, or where a < 0 outside of them; without roots everywhere or nowhere. A root may be infinite.
  float discriminant = nearest_equation.y * nearest_equation.y - a * nearest_equation.z;
  bool real = discriminant >= 0.0f && (a != 0.0f || b != 0.0f);
  float root = sqrt(maximum(discriminant, 0.0f));
  vec2 here = quadratic_roots(a, b, c, root);
  vec2 there = quadratic_roots(a, nearest_equation.y, nearest_equation.z, root);
  float s0 = abs(here.x) <= abs(there.x) ? here.x : nearest_at + there.x;
  float s1 = abs(here.y) <= abs(there.y) ? here.y : nearest_at + there.y;
  float low = real ? minimum(s0, s1) : c <= 0.0f ? -T_MISS : T_MISS;
  float high = real ? maximum(s0, s1) : -low;

  // The shape is inside of both: from `first` to `second`, and where it is outside the roots also from `third` to `leave`.
  bool between = a >= 0.0f || !real;
  float first = between ? maximum(enter, low) : enter;
  float second = minimum(leave, between ? high : low);
  float third = between ? T_MISS : maximum(enter, high);
  bool one = first <= second;
  bool two = third <= leave;

#if HAS_CSG
  // Stretches that touch are one.
  if (one && two && t + third <= t + second) {
    second = leave;
    two = false;
  }
  bool inside = ray.side == SIDE_INSIDE;
#endif

  float nearest = T_MISS;
#if HAS_CSG
  if (ray.side != SIDE_UNKNOWN) {
    bool first_of_them = one && (inside ? t + second >= ray.after : t + first > ray.after);
    nearest = first_of_them ? (inside ? second : first) : two ? (inside ? leave : third) : T_MISS;
  } else
#endif
  if (open) {
    if (low >= enter && low <= leave && t + low > 0.0f) nearest = low;
    if (high >= enter && high <= leave && t + high > 0.0f) nearest = minimum(nearest, high);
  } else {
    if (one && t + first > 0.0f) nearest = first;
    if (one && t + second > 0.0f) nearest = minimum(nearest, second);
    if (two && t + third > 0.0f) nearest = minimum(nearest, third);
    if (two && t + leave > 0.0f) nearest = minimum(nearest, leave);
  }
  part = nearest == low || nearest == high ? PART_QUADRIC : nearest == enter ? PART_ENTRY : PART_EXIT;
  return nearest;
}

SHADER_END
#endif
