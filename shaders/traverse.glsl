// Rays against the whole scene. Everything else asks `trace` and `occlusion` and knows no traversal.
// The entry gives the loaders and, of what is in no tree, KIND_FIRST(name) and KIND_END(name), or SCENE_PRIMITIVES: every primitive as a
// constant.
#ifndef TRAVERSE_GLSL
#define TRAVERSE_GLSL
#include "holes.glsl"
#include "instance.glsl"
#include "ray.glsl"
#include "records.h"
#include "tree.glsl"

SHADER_BEGIN

// What a search has found so far: the nearest hit, or how much of a shadow ray is lost.
struct Found {
  Hit hit;
  uint occluded;
#if STEPS_MAY_RUN_OUT
  float sure_until;  // the least t at which the steps of a shape's search ran out; T_MISS if none's did
#endif
};

// Takes note of a shape that gave up.
void note_steps(INOUT(Found) found, float t, vec2 uv) {
#if STEPS_MAY_RUN_OUT
  found.sure_until = t == T_RAN_OUT && !(uv.x >= found.sure_until) ? uv.x : found.sure_until;
#endif
}

// FLAG_RAN_OUT if what was found may be wrong: if a shape gave up before the nearest hit, or before the light that still arrives. Of
// what lies behind it does not matter which shapes were asked, and so this does not depend on the order either.
uint ran_out(Found found) {
#if STEPS_MAY_RUN_OUT
  return !(found.sure_until >= found.hit.t) && found.occluded < SHADOW_OPAQUE ? FLAG_RAN_OUT : 0u;
#else
  return 0u;
#endif
}

// Takes an intersection into account. `any`: the sum of what is met before hit.t, else the nearest with t > 0. Of exactly equal ones
// the lowest id stays, so that neither the order of traversal nor that of the slots matters.
void meet(INOUT(Found) found, float t, vec2 uv, uint slot, uint id, uint instance, uint density, bool any) {
  note_steps(found, t, uv);
  if (any) {
    uint sum = t > 0.0f && t < found.hit.t ? found.occluded + density : found.occluded;
    found.occluded = sum < SHADOW_OPAQUE ? sum : SHADOW_OPAQUE;
  } else {
    bool nearer = t > 0.0f && (t < found.hit.t || (t == found.hit.t && id < found.hit.id));
    found.hit.t = nearer ? t : found.hit.t;
    found.hit.slot = nearer ? slot : found.hit.slot;
    found.hit.id = nearer ? id : found.hit.id;
    found.hit.instance = nearer ? instance : found.hit.instance;
    found.hit.uv = nearer ? uv : found.hit.uv;
  }
}

// What a primitive, a solid or not, weakens a shadow ray by before t_max. A solid may have surfaces of several materials.
uint shadow_density(Primitive primitive, bool is_solid, Ray ray, float t_max, bool any) {
#if HAS_MIXED_SOLIDS
  if (any && is_solid) return solid_density(primitive, ray, t_max);
#endif
  return primitive.head.z;
}

#ifdef SCENE_PRIMITIVES
// The same where ids come in ascending order: of equal ones the first stays.
void meet_in_order(INOUT(Found) found, float t, vec2 uv, uint slot, uint id, uint density, bool any) {
  if (any) {
    meet(found, t, uv, slot, id, NONE, density, true);
  } else {
    note_steps(found, t, uv);
    bool nearer = t > 0.0f && t < found.hit.t;
    found.hit.t = nearer ? t : found.hit.t;
    found.hit.slot = nearer ? slot : found.hit.slot;
    found.hit.id = nearer ? id : found.hit.id;
    found.hit.uv = nearer ? uv : found.hit.uv;
  }
}
#else
// A primitive of the tree that `place` is in, whose shape the ray meets at t_shape.
void meet_in_tree(INOUT(Found) found, float t_shape, vec2 uv, uint slot, Primitive primitive, bool is_solid, Place place, bool any) {
  float t = unless_in_hole(primitive, place.instance, place.ray, t_shape, uv);
  uint density = place.density;
  if (HAS_INSTANCES == 0 || density == NONE) density = shadow_density(primitive, is_solid, place.ray, found.hit.t, any);
  meet(found, t, uv, slot, id_at(place, primitive), place.instance, density, any);
}

#define INTERSECT_KIND(name, number) \
  if (TREE_HOLDS(number, primitive)) t = name##_intersect(primitive, place.ray, uv);

// One that does not wait.
void meet_slot(INOUT(Found) found, uint slot, Place place, bool any) {
  Primitive primitive = load_primitive(slot);
  vec2 uv = vec2(0.0f, 0.0f);
  float t = -1.0f;
  QUICK_SHAPES(INTERSECT_KIND)
  meet_in_tree(found, t, uv, slot, primitive, HAS_SLOW_SHAPES == 0 && kind_of(primitive) == KIND_solid, place, any);
}

#if HAS_SLOW_SHAPES
void meet_slow_slot(INOUT(Found) found, uint slot, Place place, bool any) {
  Primitive primitive = load_primitive(slot);
  vec2 uv = vec2(0.0f, 0.0f);
  float t = -1.0f;
  SLOW_SHAPES(INTERSECT_KIND)
  meet_in_tree(found, t, uv, slot, primitive, kind_of(primitive) == KIND_solid, place, any);
}
#endif

bool is_slow(uint slot) {
  bool slow = false;
#if HAS_SLOW_SHAPES
  uint kind = kind_of(load_primitive(slot));
#define IS_KIND(name, number) slow = slow || kind == number;
  SLOW_SHAPES(IS_KIND)
#endif
  return slow;
}

// Walks the tree of the world, and of every instance on the way. A driver that runs both sides of every branch runs what is in a loop as often as the ray that
// needs it most; so a ray that comes to a slow shape waits there until the other rays have come to one as well, or are done.
void walk(INOUT(Found) found, Place world, bool any) {
  Place place = world;
  BoxRay boxes = box_ray(place.ray, load_tree(0u));
  Stack stack = empty_stack();
  uint at = load_tree(0u).head.x;
  do {
#if HAS_SLOW_SHAPES
    do {
#endif
      // Go down to a leaf, nearer child first. Back from an instance or a slow shape, a leaf may be next.
      if (HAS_INSTANCES + HAS_SLOW_SHAPES == 0 || at < LEAF) do {
        Child a = load_child(at, 0u, boxes);
        Child b = load_child(at, 1u, boxes);
        int limit = floatBitsToInt(found.hit.t);
        int entry_a = entry_of(a, boxes);
        int entry_b = entry_of(b, boxes);
        bool meets_a = entry_a <= exit_of(a, boxes, limit);
        bool meets_b = entry_b <= exit_of(b, boxes, limit);
        bool swap = entry_b < entry_a;
        bool both = meets_a && meets_b;
        at = both ? (swap ? b.refers_to : a.refers_to)
                  : meets_a ? a.refers_to : meets_b ? b.refers_to : top_of(stack);
        move_stack(stack, both, !meets_a && !meets_b, swap ? a.refers_to : b.refers_to);
      } while (at < LEAF);

      // Test the primitives of this leaf, and of those that wait on top of the stack. From a slow one on, what is left of a leaf is one.
      if (at < INSTANCE_LEAF) {
        bool waits = false;
        do {
          // Tested at the top: Mesa 22.3.6 may take what such a loop's last round computed from the rounds of other rays, if it ends at
          // the bottom (docs/lavapipe.md).
          uint slot = (at & ~LEAF) >> 3u;
          uint end = slot + (at & 7u) + 1u;
          for (; slot < end && !is_slow(slot); slot++) meet_slot(found, slot, place, any);
          bool lost = any && found.occluded >= SHADOW_OPAQUE;
          waits = slot < end && !lost;
          at = lost ? TREE_DONE : waits ? LEAF | slot << 3u | (end - slot - 1u) : top_of(stack);
          move_stack(stack, false, !waits, 0u);
        } while (at >= LEAF && at < INSTANCE_LEAF && !waits);
      }
#if HAS_SLOW_SHAPES
    } while (at < LEAF);

    if (at < INSTANCE_LEAF) {
      meet_slow_slot(found, (at & ~LEAF) >> 3u, place, any);
      bool last = (at & 7u) == 0u;
      at = any && found.occluded >= SHADOW_OPAQUE ? TREE_DONE : last ? top_of(stack) : at + 8u - 1u;
      move_stack(stack, false, last, 0u);
    }
#endif

#if HAS_INSTANCES
    // Go into an instance, or come back from one.
    if (at >= INSTANCE_LEAF && at != TREE_DONE) {
      bool leaving = at == TREE_LEAVE;
      uint index = at & ~INSTANCE_LEAF;
      Instance instance = load_instance(leaving ? 0u : index);
      Tree tree = load_tree(leaving ? 0u : instance.head.x);
      if (leaving) {
        place = world;
        at = top_of(stack);
      } else {
        place = into_instance(world.ray, instance, index);
        at = tree.head.x;
      }
      boxes = box_ray(place.ray, tree);
      move_stack(stack, !leaving, leaving, TREE_LEAVE);
    }
#endif
  } while (at != TREE_DONE);
}
#endif

// Before a search: only what is nearer than t_max counts.
Found nothing_found(float t_max) {
  Found found;
  found.hit.t = t_max;
  found.hit.slot = NONE;
  found.hit.id = 0u;
  found.hit.instance = NONE;
  found.hit.uv = vec2(0.0f, 0.0f);
  found.occluded = 0u;
#if STEPS_MAY_RUN_OUT
  found.sure_until = T_MISS;
#endif
  return found;
}

// Tests one by one whatever is in no tree: unbounded shapes, or with brute force all of the world's own.
void meet_loose(INOUT(Found) found, Ray ray, bool any) {
  vec2 uv = vec2(0.0f, 0.0f);
#ifdef SCENE_PRIMITIVES
#define MEET_ONE(name, index, constants)                                                    \
  {                                                                                         \
    float t = name##_intersect(constants, ray, uv);                                         \
    t = unless_in_hole(constants, NONE, ray, t, uv);                                        \
    meet_in_order(found, t, uv, index, constants.head.x, constants.head.z, any);            \
  }
  SCENE_PRIMITIVES(MEET_ONE)
#else
  // Of a kind that has nothing here there is no code: of a loop that makes no round Mesa 22.3.6 would not leave it out.
#define MEET_KIND(name, number)                                                                  \
  if (KIND_FIRST(name) < KIND_END(name))                                                         \
    for (uint i = KIND_FIRST(name); i < KIND_END(name) && found.occluded < SHADOW_OPAQUE; i++) { \
      Primitive primitive = load_primitive(i);                                                   \
      float t = name##_intersect(primitive, ray, uv);                                            \
      t = unless_in_hole(primitive, NONE, ray, t, uv);                                           \
      uint density = shadow_density(primitive, number == KIND_solid, ray, found.hit.t, any);     \
      meet(found, t, uv, i, primitive.head.x, NONE, density, any);                               \
    }
  SHAPES(MEET_KIND)
#endif
}

Found search(Ray ray, float t_max, bool any) {
  Found found = nothing_found(t_max);
  meet_loose(found, ray, any);
#ifndef SCENE_PRIMITIVES
#if HAS_INSTANCES
  if (!HAS_TREE) {
    for (uint i = 0u; i < INSTANCE_COUNT; i++) {
      Instance instance = load_instance(i);
      Tree tree = load_tree(instance.head.x);
      Place place = into_instance(ray, instance, i);
      for (uint slot = tree.head.y; slot < tree.head.z && found.occluded < SHADOW_OPAQUE; slot++)
        meet_slot(found, slot, place, any);
    }
  }
#endif
  if (HAS_TREE && found.occluded < SHADOW_OPAQUE) walk(found, in_world(ray), any);
#endif
  return found;
}

// The nearest hit with t > 0. Adds to `flags` what may be wrong with it.
Hit trace(Ray ray, INOUT(uint) flags) {
  Found found = search(ray, T_MISS, false);
  flags = flags | ran_out(found);
  return found.hit;
}

// How much of a shadow ray's light is lost on 0 < t < t_max: the sum of what every primitive on the way weakens it by, in
// −log2 · SHADOW_SCALE, at most SHADOW_OPAQUE. An integer sum does not depend on the order of traversal. `flags` as for trace.
uint occlusion(Ray ray, float t_max, INOUT(uint) flags) {
  Found found = search(ray, t_max, true);
  flags = flags | ran_out(found);
  return found.occluded;
}

// The share of light that passes, from what `occlusion` counted.
float visibility(uint occluded) {
  return occluded >= SHADOW_OPAQUE ? 0.0f : exp_negative(float(occluded) * (-0.693147181f / SHADOW_SCALE));
}

SHADER_END
#endif
