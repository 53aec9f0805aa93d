// One of many lights, chosen by its power, its distance, and which way it shines, down a BVH of the lights (scene/light_bvh.hpp). At each
// node the more important child is the likelier. Conty Estevez and Kulla, "Importance Sampling of Many Lights with
// Adaptive Tree Splitting" (HPG 2018).
#ifndef LIGHT_BVH_GLSL
#define LIGHT_BVH_GLSL
#include "math/math.glsl"
#include "math/rng.glsl"
#include "records.h"

SHADER_BEGIN

struct LightPick {
  uint light;  // NONE where none shines here
  float share;  // its probability
};

#if HAS_LIGHT_BVH
// Cosines count for so much at least, and borders have so much room: rounding leaves no light out that shines.
#define LEAST_COSINE_OF_LIGHT 1.0e-4f

// The cosine and the sine of an angle in [0, π] …
vec2 cosine_and_sine(float cosine) { return vec2(cosine, sqrt(maximum(1.0f - cosine * cosine, 0.0f))); }

// … and of that angle less another, 0 where the other is larger.
vec2 angle_without(vec2 angle, vec2 other) {
  if (angle.x >= other.x) return vec2(1.0f, 0.0f);
  return vec2(angle.x * other.x + angle.y * other.y, angle.y * other.x - angle.x * other.y);
}

// Estimate of the node's light that may arrive at p, where the normal is n; a normal of 0 is ignored. Above 0 wherever any does.
float light_node_importance(LightNode node, vec3 p, vec3 n) {
  vec3 way = node.center - p;
  float squared = dot3(way, way);
  float inverse = 1.0f / sqrt(maximum(squared, 1.0e-30f));
  vec3 direction = way * inverse;
  float sine = minimum(node.radius * inverse, 1.0f);
  vec2 half_sphere = vec2(sqrt(1.0f - sine * sine), sine);  // the angle that the sphere is seen under

  // The smallest angle between a normal and the way here from a point of the sphere, …
  float along_axis = -dot3(direction, node.axis);
  along_axis = node.both_sides != 0u ? abs(along_axis) : along_axis;
  vec2 leaving = angle_without(angle_without(cosine_and_sine(minimum(along_axis, 1.0f)), cosine_and_sine(node.cos_spread)), half_sphere);
  // … and between the normal here and the way there.
  vec2 arriving = angle_without(cosine_and_sine(minimum(dot3(direction, n), 1.0f)), half_sphere);

  bool shines = leaving.x > node.cos_reach - LEAST_COSINE_OF_LIGHT && (arriving.x > -LEAST_COSINE_OF_LIGHT || dot3(n, n) == 0.0f);
  float cosines = maximum(leaving.x, LEAST_COSINE_OF_LIGHT) * (dot3(n, n) == 0.0f ? 1.0f : maximum(arriving.x, LEAST_COSINE_OF_LIGHT));
  bool inside = squared <= node.radius * node.radius;
  float near = node.power / maximum(maximum(squared, node.radius * node.radius), 1.0e-30f);
  return inside ? near : shines ? near * cosines : 0.0f;
}

// Picks a light by `number`, one of the `count` that choose the BVH.
LightPick pick_by_light_bvh(vec3 p, vec3 n, uint number, uint count) {
  LightPick pick;
  pick.light = NONE;
  pick.share = 1.0f;
  float u = float(number) / float(count);
  uint pair = 0u;
  for (uint level = 0u; level < LIGHT_BVH_DEPTH; level++) {
    if (pick.light != NONE || pick.share == 0.0f) break;
    // The rest of the number serves for some levels. A rounding error in it doubles at each.
    if (level > 0u && (level & (LIGHT_BVH_LEVELS_A_NUMBER - 1u)) == 0u) u = unit_float(pcg_hash(number ^ (level << 24u)));
    LightNode first = load_light_node(pair);
    LightNode second = load_light_node(pair + 1u);
    float of_first = light_node_importance(first, p, n);
    float of_second = light_node_importance(second, p, n);
    float sum = of_first + of_second;
    float at = u * sum;
    bool takes_second = !(at < of_first);
    float taken = takes_second ? of_second : of_first;
    pick.share = sum > 0.0f ? pick.share * (taken / sum) : 0.0f;
    u = minimum((takes_second ? at - of_first : at) / maximum(taken, 1.0e-38f), 0.99999994f);
    uint child = takes_second ? second.child : first.child;
    if ((child & LEAF) != 0u) pick.light = child & ~LEAF;
    pair = child;
  }
  return pick;
}

// The probability that the choice picks the light at the end of `trail`.
float light_bvh_share(vec3 p, vec3 n, uint trail) {
  float share = 1.0f;
  uint pair = 0u;
  for (uint level = 0u; level < LIGHT_BVH_DEPTH; level++) {
    if ((pair & LEAF) != 0u || share == 0.0f) break;
    LightNode first = load_light_node(pair);
    LightNode second = load_light_node(pair + 1u);
    float of_first = light_node_importance(first, p, n);
    float of_second = light_node_importance(second, p, n);
    float sum = of_first + of_second;
    bool takes_second = ((trail >> level) & 1u) != 0u;
    share = sum > 0.0f ? share * ((takes_second ? of_second : of_first) / sum) : 0.0f;
    pair = takes_second ? second.child : first.child;
  }
  return share;
}
#endif

SHADER_END
#endif
