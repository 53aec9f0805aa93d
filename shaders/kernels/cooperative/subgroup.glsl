// Communication between the lanes of a subgroup. Written out: Mesa 22.3.6 compiles subgroupAny and subgroupAdd to loops, and does
// not unroll one over 1, 2, 4.
#ifndef SUBGROUP_GLSL
#define SUBGROUP_GLSL
#include "math/math.glsl"
#include "bvh/bvh.glsl"

#define LANES uint(SUBGROUP_SIZE)

#if SUBGROUP_SIZE >= 16
#define OVER_LANES(x, f) x = f(x, 1u); x = f(x, 2u); x = f(x, 4u); x = f(x, 8u)
#elif SUBGROUP_SIZE >= 8
#define OVER_LANES(x, f) x = f(x, 1u); x = f(x, 2u); x = f(x, 4u)
#else
#define OVER_LANES(x, f) x = f(x, 1u); x = f(x, 2u)
#endif
#define PLUS_LANE(x, i) (x + subgroupShuffleXor(x, i))
#define LESSER_LANE(x, i) lesser(x, subgroupShuffleXor(x, i))
#define MINIMUM_LANE(x, i) minimum(x, subgroupShuffleXor(x, i))
#define MAXIMUM_LANE(x, i) maximum(x, subgroupShuffleXor(x, i))

uint sum(uint x) { OVER_LANES(x, PLUS_LANE); return x; }
float sum(float x) { OVER_LANES(x, PLUS_LANE); return x; }
int least(int x) { OVER_LANES(x, LESSER_LANE); return x; }
float least(float x) { OVER_LANES(x, MINIMUM_LANE); return x; }
float largest(float x) { OVER_LANES(x, MAXIMUM_LANE); return x; }
vec2 least(vec2 v) { return vec2(least(v.x), least(v.y)); }
vec2 largest(vec2 v) { return vec2(largest(v.x), largest(v.y)); }
vec3 least(vec3 v) { return vec3(least(v.x), least(v.y), least(v.z)); }
vec3 largest(vec3 v) { return vec3(largest(v.x), largest(v.y), largest(v.z)); }
bool in_any_lane(bool x) { return sum(x ? 1u : 0u) != 0u; }

uint from_lane(uint x, uint i) { return subgroupShuffle(x, i); }
vec2 from_lane(vec2 v, uint i) { return vec2(subgroupShuffle(v.x, i), subgroupShuffle(v.y, i)); }
vec3 from_lane(vec3 v, uint i) { return vec3(from_lane(vec2(v), i), subgroupShuffle(v.z, i)); }
vec4 from_lane(vec4 v, uint i) { return vec4(from_lane(vec3(v), i), subgroupShuffle(v.w, i)); }
uvec4 from_lane(uvec4 v, uint i) {
  return uvec4(subgroupShuffle(v.x, i), subgroupShuffle(v.y, i), subgroupShuffle(v.z, i), subgroupShuffle(v.w, i));
}
Primitive from_lane(Primitive p, uint i) {
  return primitive_of(from_lane(head_of(p), i), from_lane(p.a, i), from_lane(p.b, i), from_lane(p.c, i));
}

#endif
