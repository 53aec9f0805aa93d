// Rays that run much the same way, seen from far: a shaft with four flat sides around all of them, and which boxes it hits. A box
// that the shaft misses, each of its rays misses.
// Positions count from the BVH's origin and are permuted, so that z is the axis along which the shaft runs. How far along something is
// goes from 0, where the shaft begins, to 1, where it ends.
#ifndef SHAFT_GLSL
#define SHAFT_GLSL
#include "math/math.glsl"
#include "geometry/ray.glsl"
#include "bvh/bvh.glsl"

SHADER_BEGIN

#ifndef SCENE_PRIMITIVES
#define FAR_AWAY 0x7fffffff  // as the bits of a float, beyond all distances

// The x (or y) beyond which there is no ray, a line along the shaft. A box passes it at x · scale + shift, and is within from there on
// if `enters`, else up to there.
struct Side {
  float scale;
  float shift;
  bool enters;
};

struct Shaft {
  uint major;     // the axis along which it runs
  bool backward;  // towards lower coordinates
  float slack;    // boxes are widened by this: more than any rounding, here or of a hit
  float scale;    // z is z · scale + begin along, less the widening of boxes, or + end, and as much more
  float begin;
  float end;
  Side low_x;
  Side low_y;
  Side high_x;
  Side high_y;
};

// A side that does not lean is made to lean by `slack`: it stands off by twice as much.
Side make_side(float at_begin, float at_end, float slack, bool low) {
  float stand_off = low ? -2.0f * slack : 2.0f * slack;
  float lean = at_end - at_begin;
  lean = lean < 0.0f ? minimum(lean, -slack) : maximum(lean, slack);
  Side side;
  side.scale = 1.0f / lean;
  side.shift = -(at_begin + stand_off) / lean;
  side.enters = low == (lean < 0.0f);
  return side;
}

// The shaft from z0 to z1 != z0. low and high: the least and the greatest x and y of any ray at z0 and at z1. Rays are straight, so in
// between none is outside of the lines between those.
Shaft make_shaft(uint major, float z0, float z1, vec2 low0, vec2 low1, vec2 high0, vec2 high1, float slack) {
  Shaft shaft;
  shaft.major = major;
  shaft.backward = z1 < z0;
  shaft.slack = slack;
  shaft.scale = 1.0f / (z1 - z0);
  shaft.begin = -z0 * shaft.scale - slack * abs(shaft.scale);
  shaft.end = -z0 * shaft.scale + slack * abs(shaft.scale);
  shaft.low_x = make_side(low0.x, low1.x, slack, true);
  shaft.low_y = make_side(low0.y, low1.y, slack, true);
  shaft.high_x = make_side(high0.x, high1.x, slack, false);
  shaft.high_y = make_side(high0.y, high1.y, slack, false);
  return shaft;
}

int passed_at(Side side, float x) { return floatBitsToInt(x * side.scale + side.shift); }

// The distance along the shaft of its first hit with the box, as the bits of a float.
// FAR_AWAY if it misses the box, or hits it only beyond `limit`.
// lower, upper: from the BVH's origin, not permuted.
int entry_of(Shaft shaft, vec3 lower, vec3 upper, int limit) {
  vec3 low = permute(lower, shaft.major);
  vec3 high = permute(upper, shaft.major);
  int low_x = passed_at(shaft.low_x, high.x);
  int low_y = passed_at(shaft.low_y, high.y);
  int high_x = passed_at(shaft.high_x, low.x);
  int high_y = passed_at(shaft.high_y, low.y);
  float near = shaft.backward ? high.z : low.z;
  float far = shaft.backward ? low.z : high.z;
  int entry = greater(floatBitsToInt(near * shaft.scale + shaft.begin), 0);
  entry = greater(entry, shaft.low_x.enters ? low_x : 0);
  entry = greater(entry, shaft.low_y.enters ? low_y : 0);
  entry = greater(entry, shaft.high_x.enters ? high_x : 0);
  entry = greater(entry, shaft.high_y.enters ? high_y : 0);
  int exit = lesser(floatBitsToInt(far * shaft.scale + shaft.end), limit);
  exit = lesser(exit, shaft.low_x.enters ? FAR_AWAY : low_x);
  exit = lesser(exit, shaft.low_y.enters ? FAR_AWAY : low_y);
  exit = lesser(exit, shaft.high_x.enters ? FAR_AWAY : high_x);
  exit = lesser(exit, shaft.high_y.enters ? FAR_AWAY : high_y);
  return entry <= exit ? entry : FAR_AWAY;
}
#endif

SHADER_END
#endif
