// Rays against the whole scene. Everything else calls `trace` and `occlusion` and knows no traversal.
// The entry gives the loaders and, for shapes in no BVH, KIND_FIRST(name) and KIND_END(name), or SCENE_PRIMITIVES: every primitive as a
// constant.
#ifndef TRAVERSE_GLSL
#define TRAVERSE_GLSL
#include "bvh/alpha_test.glsl"
#include "geometry/instance.glsl"
#include "geometry/ray.glsl"
#include "records.h"
#include "bvh/bvh.glsl"

SHADER_BEGIN

// The result of a search so far: the nearest hit, or a shadow ray's loss.
struct TraversalState {
  Hit hit;
  uint occluded;
#if MAY_REACH_ITERATION_LIMIT
  float sure_until;  // the least t at which a shape's search reached its iteration limit; T_MISS if none did
#endif
#if SEARCH_COST
  uint nodes;  // visited nodes of BVHs so far
  uint tests;  // primitives tested so far
#endif
};

// Kernels that need not report the cost of a search hold nothing of this.
#if SEARCH_COST
#define COUNT_NODE(state) state.nodes += 1u
#define COUNT_TEST(state) state.tests += 1u
#else
#define COUNT_NODE(state)
#define COUNT_TEST(state)
#endif

// Takes note of a shape that gave up.
void note_iteration_limit(INOUT(TraversalState) state, float t, vec2 uv) {
#if MAY_REACH_ITERATION_LIMIT
  state.sure_until = t == T_ITERATION_LIMIT && !(uv.x >= state.sure_until) ? uv.x : state.sure_until;
#endif
}

// FLAG_ITERATION_LIMIT if the result may be wrong: if a shape gave up before the nearest hit, or before the light that still arrives. It
// does not matter which shapes behind that were tested, and so this does not depend on the order either.
uint iteration_limit(TraversalState state) {
#if MAY_REACH_ITERATION_LIMIT
  return !(state.sure_until >= state.hit.t) && state.occluded < OPTICAL_DEPTH_OPAQUE ? FLAG_ITERATION_LIMIT : 0u;
#else
  return 0u;
#endif
}

// The nearest hit with t > 0: of exactly equal ones that of the lowest id, and of a shape's several primitives that of the lowest uv.x, then of the
// lowest uv.y. So neither the order of traversal nor that of the slots matters.
void update_closest_hit(INOUT(TraversalState) state, float t, vec2 uv, uint slot, uint id, uint instance) {
#if HAS_PIECES
  bool precedes = id < state.hit.id || (id == state.hit.id && (uv.x < state.hit.uv.x || (uv.x == state.hit.uv.x && uv.y < state.hit.uv.y)));
#else
  bool precedes = id < state.hit.id;
#endif
  bool nearer = t > 0.0f && (t < state.hit.t || (t == state.hit.t && precedes));
  state.hit.t = nearer ? t : state.hit.t;
  state.hit.slot = nearer ? slot : state.hit.slot;
  state.hit.id = nearer ? id : state.hit.id;
  state.hit.instance = nearer ? instance : state.hit.instance;
  state.hit.uv = nearer ? uv : state.hit.uv;
}

// The optical depth of all that is hit before hit.t.
void accumulate_occlusion(INOUT(TraversalState) state, float t, uint optical_depth) {
  uint sum = t > 0.0f && t < state.hit.t ? state.occluded + optical_depth : state.occluded;
  state.occluded = sum < OPTICAL_DEPTH_OPAQUE ? sum : OPTICAL_DEPTH_OPAQUE;
}

// Takes an intersection into account, for any-hit or closest-hit.
void record_intersection(INOUT(TraversalState) state, float t, vec2 uv, uint slot, uint id, uint instance, uint optical_depth, bool any) {
  note_iteration_limit(state, t, uv);
  if (any) accumulate_occlusion(state, t, optical_depth);
  else update_closest_hit(state, t, uv, slot, id, instance);
}

// The optical depth of a primitive for a shadow ray before t_max. A CSG object may have surfaces of several materials.
uint optical_depth_of(Primitive primitive, bool is_csg, Ray ray, float t_max, bool any) {
#if HAS_MIXED_CSG
  if (any && is_csg) return csg_optical_depth(primitive, ray, t_max);
#endif
  return primitive.optical_depth;
}

#ifdef SCENE_PRIMITIVES
// Records an intersection where ids come in ascending order: of hits at the same t the first stays.
void record_in_order(INOUT(TraversalState) state, float t, vec2 uv, uint slot, uint id, uint optical_depth, bool any) {
  if (any) {
    record_intersection(state, t, uv, slot, id, NONE, optical_depth, true);
  } else {
    note_iteration_limit(state, t, uv);
    bool nearer = t > 0.0f && t < state.hit.t;
    state.hit.t = nearer ? t : state.hit.t;
    state.hit.slot = nearer ? slot : state.hit.slot;
    state.hit.id = nearer ? id : state.hit.id;
    state.hit.uv = nearer ? uv : state.hit.uv;
  }
}
#else
// Records a primitive of the BVH that `local` is in, whose shape the ray hits at t_shape.
void record_in_bvh(INOUT(TraversalState) state, float t_shape, vec2 uv, uint slot, Primitive primitive, bool is_csg, LocalRay local, bool any) {
  float t = alpha_test(primitive, id_of(local, primitive), local.instance, local.ray, t_shape, uv);
  uint optical_depth = local.optical_depth;
  if (HAS_INSTANCES == 0 || optical_depth == NONE) optical_depth = optical_depth_of(primitive, is_csg, local.ray, state.hit.t, any);
  record_intersection(state, t, uv, slot, id_of(local, primitive), local.instance, optical_depth, any);
}

#define INTERSECT_KIND(name, number) \
  if (BVH_HOLDS(number, primitive)) t = name##_intersect(primitive, local.ray, uv);

// Intersects a shape that does not wait.
void intersect_slot(INOUT(TraversalState) state, uint slot, LocalRay local, bool any) {
  Primitive primitive = load_primitive(slot);
  vec2 uv = vec2(0.0f, 0.0f);
  float t = -1.0f;
  COUNT_TEST(state);
  IMMEDIATE_SHAPES(INTERSECT_KIND)
  record_in_bvh(state, t, uv, slot, primitive, HAS_DEFERRED_SHAPES == 0 && kind_of(primitive) == KIND_csg, local, any);
}

#if HAS_DEFERRED_SHAPES
void intersect_deferred(INOUT(TraversalState) state, uint slot, LocalRay local, bool any) {
  Primitive primitive = load_primitive(slot);
  vec2 uv = vec2(0.0f, 0.0f);
  float t = -1.0f;
  COUNT_TEST(state);
  DEFERRED_SHAPES(INTERSECT_KIND)
  record_in_bvh(state, t, uv, slot, primitive, kind_of(primitive) == KIND_csg, local, any);
}
#endif

bool is_deferred(uint slot) {
  bool deferred = false;
#if HAS_DEFERRED_SHAPES
  uint kind = kind_of(load_primitive(slot));
#define IS_KIND(name, number) deferred = deferred || kind == number;
  DEFERRED_SHAPES(IS_KIND)
#endif
  return deferred;
}

// Traverses the TLAS, and the BVH of every instance on the way. A driver that runs both sides of every branch runs a loop's body as often
// as the ray that needs it most. So a ray that comes to a deferred shape waits there until the others have come to one too, or are done.
void traverse(INOUT(TraversalState) state, LocalRay world, bool any) {
  LocalRay local = world;
  BoxRay boxes = box_ray(local.ray, load_bvh(0u));
  Stack stack = empty_stack();
  uint at = load_bvh(0u).root;
  do {
#if HAS_DEFERRED_SHAPES
    do {
#endif
      // Go down to a leaf, nearer child first. Back from an instance or a deferred shape, a leaf may be next.
      if (HAS_INSTANCES + HAS_DEFERRED_SHAPES == 0 || at < LEAF) do {
        COUNT_NODE(state);
        Child a = load_child(at, 0u, boxes);
        Child b = load_child(at, 1u, boxes);
        int limit = floatBitsToInt(state.hit.t);
        int entry_a = entry_of(a, boxes);
        int entry_b = entry_of(b, boxes);
        bool hits_a = entry_a <= exit_of(a, boxes, limit);
        bool hits_b = entry_b <= exit_of(b, boxes, limit);
        bool swap = entry_b < entry_a;
        bool both = hits_a && hits_b;
        at = both ? (swap ? b.refers_to : a.refers_to)
                  : hits_a ? a.refers_to : hits_b ? b.refers_to : top_of(stack);
        move_stack(stack, both, !hits_a && !hits_b, swap ? a.refers_to : b.refers_to);
      } while (at < LEAF);

      // Test the primitives of this leaf, and of those that wait on top of the stack. From a deferred one on, the rest is again a leaf.
      if (at < INSTANCE_LEAF) {
        bool waits = false;
        do {
          // Tested at the top: if such a loop ends at the bottom, Mesa 22.3.6 may take results of its last iteration from other rays' iterations
          // (docs/lavapipe.md).
          uint slot = (at & ~LEAF) >> 3u;
          uint end = slot + (at & 7u) + 1u;
          for (; slot < end && !is_deferred(slot); slot++) intersect_slot(state, slot, local, any);
          bool lost = any && state.occluded >= OPTICAL_DEPTH_OPAQUE;
          waits = slot < end && !lost;
          at = lost ? TRAVERSAL_DONE : waits ? LEAF | slot << 3u | (end - slot - 1u) : top_of(stack);
          move_stack(stack, false, !waits, 0u);
        } while (at >= LEAF && at < INSTANCE_LEAF && !waits);
      }
#if HAS_DEFERRED_SHAPES
    } while (at < LEAF);

    if (at < INSTANCE_LEAF) {
      intersect_deferred(state, (at & ~LEAF) >> 3u, local, any);
      bool last = (at & 7u) == 0u;
      at = any && state.occluded >= OPTICAL_DEPTH_OPAQUE ? TRAVERSAL_DONE : last ? top_of(stack) : at + 8u - 1u;
      move_stack(stack, false, last, 0u);
    }
#endif

#if HAS_INSTANCES
    // Go into an instance, or come back from one.
    if (at >= INSTANCE_LEAF && at != TRAVERSAL_DONE) {
      bool leaving = at == LEAVE_INSTANCE;
      uint index = at & ~INSTANCE_LEAF;
      Instance instance = load_instance(leaving ? 0u : index);
      Bvh bvh = load_bvh(leaving ? 0u : instance.bvh);
      if (leaving) {
        local = world;
        at = top_of(stack);
      } else {
        local = into_instance(world.ray, instance, index);
        at = bvh.root;
      }
      boxes = box_ray(local.ray, bvh);
      move_stack(stack, !leaving, leaving, LEAVE_INSTANCE);
    }
#endif
  } while (at != TRAVERSAL_DONE);
}
#endif

// Before a search: only hits nearer than t_max count.
TraversalState traversal_state(float t_max) {
  TraversalState state;
  state.hit.t = t_max;
  state.hit.slot = NONE;
  state.hit.id = 0u;
  state.hit.instance = NONE;
  state.hit.uv = vec2(0.0f, 0.0f);
  state.occluded = 0u;
#if MAY_REACH_ITERATION_LIMIT
  state.sure_until = T_MISS;
#endif
#if SEARCH_COST
  state.nodes = 0u;
  state.tests = 0u;
#endif
  return state;
}

// Tests one by one all shapes in no BVH: unbounded shapes, or with brute force all of the world's own.
void intersect_linear_list(INOUT(TraversalState) state, Ray ray, bool any) {
  vec2 uv = vec2(0.0f, 0.0f);
#ifdef SCENE_PRIMITIVES
#define INTERSECT_CONSTANT(name, index, constants)                                                    \
  {                                                                                         \
    COUNT_TEST(state);                                                                      \
    float t = name##_intersect(constants, ray, uv);                                         \
    t = alpha_test(constants, constants.id, NONE, ray, t, uv);                              \
    record_in_order(state, t, uv, index, constants.id, constants.optical_depth, any);            \
  }
  SCENE_PRIMITIVES(INTERSECT_CONSTANT)
#else
  // A kind without primitives here gets no code: Mesa 22.3.6 would keep a loop of no iterations.
#define INTERSECT_LINEAR_LIST(name, number)                                                                  \
  if (KIND_FIRST(name) < KIND_END(name))                                                         \
    for (uint i = KIND_FIRST(name); i < KIND_END(name) && state.occluded < OPTICAL_DEPTH_OPAQUE; i++) { \
      Primitive primitive = load_primitive(i);                                                   \
      COUNT_TEST(state);                                                                         \
      float t = name##_intersect(primitive, ray, uv);                                            \
      t = alpha_test(primitive, primitive.id, NONE, ray, t, uv);                                   \
      uint optical_depth = optical_depth_of(primitive, number == KIND_csg, ray, state.hit.t, any);     \
      record_intersection(state, t, uv, i, primitive.id, NONE, optical_depth, any);                               \
    }
  SHAPES(INTERSECT_LINEAR_LIST)
#endif
}

TraversalState search(Ray ray, float t_max, bool any) {
  TraversalState state = traversal_state(t_max);
  intersect_linear_list(state, ray, any);
#ifndef SCENE_PRIMITIVES
#if HAS_INSTANCES
  if (!HAS_BVH) {
    for (uint i = 0u; i < INSTANCE_COUNT; i++) {
      Instance instance = load_instance(i);
      Bvh bvh = load_bvh(instance.bvh);
      LocalRay local = into_instance(ray, instance, i);
      for (uint slot = bvh.first_slot; slot < bvh.end_slot && state.occluded < OPTICAL_DEPTH_OPAQUE; slot++)
        intersect_slot(state, slot, local, any);
    }
  }
#endif
  if (HAS_BVH && state.occluded < OPTICAL_DEPTH_OPAQUE) traverse(state, world_ray(ray), any);
#endif
  return state;
}

// The nearest hit with t > 0. Adds to `flags` the ways in which it may be wrong.
Hit trace(Ray ray, INOUT(uint) flags) {
  TraversalState state = search(ray, T_MISS, false);
  flags = flags | iteration_limit(state);
  return state.hit;
}

// The loss of a shadow ray's light on 0 < t < t_max: the sum of the optical depths of all primitives on its way, in −log2 · OPTICAL_DEPTH_SCALE, at
// most OPTICAL_DEPTH_OPAQUE. An integer sum does not depend on the order of traversal. `flags` as for trace.
uint occlusion(Ray ray, float t_max, INOUT(uint) flags) {
  TraversalState state = search(ray, t_max, true);
  flags = flags | iteration_limit(state);
  return state.occluded;
}

// The share of light that passes, from the count that `occlusion` returns.
float visibility(uint occluded) {
  return occluded >= OPTICAL_DEPTH_OPAQUE ? 0.0f : exp_negative(float(occluded) * (-0.693147181f / OPTICAL_DEPTH_SCALE));
}

SHADER_END
#endif
