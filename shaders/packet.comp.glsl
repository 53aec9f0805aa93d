// Entry: rays that run side by side, PACKET at a time. All lanes of a subgroup walk the tree together, each with several rays: a node is
// loaded once for all, a word a lane, and so is the stack kept, an entry a lane. What a ray hits is what `search` finds
// (traverse.glsl), since neither asks in which order.
//   PACKET_PRIMARY   the rays of a tile's pixels → PacketHit
//   PACKET_SHADOW    from what those hit to every light → occlusion
//   otherwise rays from a buffer → QueryHit, with QUERY_ANY whether there is one
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#include "scene.glsl"
#include "pixel.glsl"
#include "tile.glsl"

#if defined(PACKET_SHADOW) || defined(QUERY_ANY)
#define ANY true
#else
#define ANY false
#endif

layout(local_size_x = 64) in;
#if defined(PACKET_PRIMARY) || defined(PACKET_SHADOW)
layout(std430, binding = BINDING_PACKET_HITS) restrict buffer PacketHits { PacketHit hits[]; };
layout(std430, binding = BINDING_OCCLUSIONS) writeonly restrict buffer Occlusions { uint occlusions[]; };
#else
layout(std430, binding = BINDING_RAYS) readonly restrict buffer Rays { QueryRay rays[]; };
layout(std430, binding = BINDING_OUTPUT) writeonly restrict buffer Results { QueryHit results[]; };
#endif

#define LANES uint(SUBGROUP_SIZE)
#define RAYS_A_LANE (PACKET / SUBGROUP_SIZE)
#define STACK_WORDS ((STACK_SIZE + SUBGROUP_SIZE - 1) / SUBGROUP_SIZE)
#define NODE_WORDS (QUANTISED_NODES ? 2u : 4u)
#define FAR_AWAY 0x7fffffff
#define EACH [[unroll]] for (int k = 0; k < RAYS_A_LANE; k++)

// Written out: 22.3.6 compiles subgroupAny and subgroupAdd to loops.
int sum_of_lanes(int x) {
  x += subgroupShuffleXor(x, 1u);
  x += subgroupShuffleXor(x, 2u);
#if SUBGROUP_SIZE >= 8
  x += subgroupShuffleXor(x, 4u);
#endif
#if SUBGROUP_SIZE >= 16
  x += subgroupShuffleXor(x, 8u);
#endif
  return x;
}
uvec4 from_lane(uvec4 word, uint lane) {
  return uvec4(subgroupShuffle(word.x, lane), subgroupShuffle(word.y, lane), subgroupShuffle(word.z, lane),
               subgroupShuffle(word.w, lane));
}
float largest_of_lanes(float x) {
  x = maximum(x, subgroupShuffleXor(x, 1u));
  x = maximum(x, subgroupShuffleXor(x, 2u));
#if SUBGROUP_SIZE >= 8
  x = maximum(x, subgroupShuffleXor(x, 4u));
#endif
#if SUBGROUP_SIZE >= 16
  x = maximum(x, subgroupShuffleXor(x, 8u));
#endif
  return x;
}

Ray ray[RAYS_A_LANE];
Found found[RAYS_A_LANE];
vec3 scale[RAYS_A_LANE];
vec3 shift[RAYS_A_LANE];

// A box that all rays are tested against: its planes, moved outwards by what BoxRay allows for.
struct PacketChild {
  vec3 lower;
  vec3 upper;
  uint refers_to;
};

PacketChild child_of(uvec4 word, uint which, vec3 slack) {
  PacketChild child;
  if (QUANTISED_NODES) {
    uvec4 c = from_lane(word, which);
    child.lower = vec3(low_half(c.x), low_half(c.y), low_half(c.z)) - slack;
    child.upper = vec3(low_half(c.x >> 16u), low_half(c.y >> 16u), low_half(c.z >> 16u)) + slack;
    child.refers_to = c.w;
  } else {
    uvec4 c = from_lane(word, 2u * which);
    uvec4 d = from_lane(word, 2u * which + 1u);
    child.lower = vec3(uintBitsToFloat(c.x), uintBitsToFloat(c.y), uintBitsToFloat(c.z)) - slack;
    child.upper = vec3(uintBitsToFloat(d.x), uintBitsToFloat(d.y), uintBitsToFloat(d.z)) + slack;
    child.refers_to = c.w;
  }
  return child;
}

// The least distance at which a ray of this lane enters, FAR_AWAY if none does.
int first_entry(PacketChild child) {
  int first = FAR_AWAY;
  EACH {
    vec3 a = child.lower * scale[k] - shift[k];
    vec3 b = child.upper * scale[k] - shift[k];
    float near = maximum(maximum(minimum(a.x, b.x), minimum(a.y, b.y)), minimum(a.z, b.z));
    float far = minimum(minimum(maximum(a.x, b.x), maximum(a.y, b.y)), maximum(a.z, b.z));
    int entry = greater(floatBitsToInt(near), 0);
    int exit = lesser(floatBitsToInt(far), floatBitsToInt(found[k].hit.t));
    first = lesser(first, entry <= exit ? entry : FAR_AWAY);
  }
  return first;
}

void walk_together(uint lane) {
  // Widen the boxes for the ray that starts farthest away.
  Tree tree = load_tree(0u);
  float reach = 0.0f;
  EACH {
    vec3 offset = ray[k].o - vec3(tree.origin);
    scale[k] = vec3(tree.step) * ray[k].inverse;
    shift[k] = offset * ray[k].inverse;
    reach = maximum(reach, max_component(abs3(offset) + vec3(tree.extent)));
  }
  vec3 slack = vec3(tree.extent.w * largest_of_lanes(reach)) / vec3(tree.step);

  uint stack[STACK_WORDS];
  [[unroll]] for (int i = 0; i < STACK_WORDS; i++) stack[i] = TREE_DONE;
  uint waiting = 1u;
  uint at = tree.head.x;
  do {
    do {
      uvec4 word = load_node(NODE_WORDS * at + (lane & (NODE_WORDS - 1u)));
      PacketChild a = child_of(word, 0u, slack);
      PacketChild b = child_of(word, 1u, slack);
      int first_a = first_entry(a);
      int first_b = first_entry(b);
      // Lanes vote on which child to visit, and which first.
      int votes = sum_of_lanes((first_a != FAR_AWAY ? 1 : 0) + (first_b != FAR_AWAY ? 0x100 : 0) +
                               (first_b < first_a ? 0x10000 : 0) - (first_a < first_b ? 0x10000 : 0));
      bool meets_a = (votes & 0xff) != 0;
      bool meets_b = (votes & 0xff00) != 0;
      bool swap = votes < 0x10000 ? false : true;
      bool push = meets_a && meets_b;
      bool pop = !meets_a && !meets_b;
      uint later = swap ? a.refers_to : b.refers_to;
      uint next = push ? (swap ? b.refers_to : a.refers_to) : meets_a ? a.refers_to : b.refers_to;
      uint top = waiting - (pop ? 1u : 0u);
      bool mine = (top & (LANES - 1u)) == lane;
      uint held = TREE_DONE;
      [[unroll]] for (int i = 0; i < STACK_WORDS; i++) {
        bool here = top / LANES == uint(i);
        held = here ? stack[i] : held;
        stack[i] = push && here && mine ? later : stack[i];
      }
      at = pop ? subgroupShuffle(held, top & (LANES - 1u)) : next;
      waiting = push ? waiting + 1u : top;
    } while (at < LEAF);

    if (at != TREE_DONE) {
      do {
        uint slot = (at & ~LEAF) >> 3u;
        uint end = slot + (at & 7u) + 1u;
        for (; slot < end; slot++) {
          uvec4 word = load_primitive_word(4u * slot + (lane & 3u));
          Primitive primitive;
          primitive.head = from_lane(word, 0u);
          primitive.a = bits_to_floats(from_lane(word, 1u));
          primitive.b = bits_to_floats(from_lane(word, 2u));
          primitive.c = bits_to_floats(from_lane(word, 3u));
          EACH {
            vec2 uv = vec2(0.0f, 0.0f);
            float t = -1.0f;
#define INTERSECT_TOGETHER(name, number) \
            if (TREE_HOLDS(number, primitive)) t = name##_intersect(primitive, ray[k], uv);
            SHAPES(INTERSECT_TOGETHER)
            meet(found[k], t, uv, slot, primitive.head.x, NONE, primitive.head.z, ANY);
          }
        }
        waiting -= 1u;
        uint held = TREE_DONE;
        [[unroll]] for (int i = 0; i < STACK_WORDS; i++) held = waiting / LANES == uint(i) ? stack[i] : held;
        at = subgroupShuffle(held, waiting & (LANES - 1u));
#if defined(PACKET_SHADOW) || defined(QUERY_ANY)
        // A ray that is wholly in shadow meets nothing more.
        EACH found[k].hit.t = found[k].occluded >= SHADOW_OPAQUE ? -1.0f : found[k].hit.t;
#endif
      } while (at >= LEAF && at != TREE_DONE);
    }
  } while (at != TREE_DONE);
}

// Where the result of ray i of a packet goes; NONE where there is no such ray.
uint place_of(uint packet, uint i) {
  uint j = packet * uint(PACKET) + i;
#if defined(PACKET_PRIMARY) || defined(PACKET_SHADOW)
  uvec2 pixel = pixel_of_block(j / 64u, j % 64u, dispatch.tile);
  bool there = pixel.x < dispatch.tile.z && pixel.y < dispatch.tile.w;
  return there ? pixel.y * dispatch.tile.z + pixel.x : NONE;
#else
  return j < dispatch.tile.x ? j : NONE;
#endif
}

#if defined(PACKET_PRIMARY) || defined(PACKET_SHADOW)
// The sample's ray through the pixel at `place` of the tile.
Ray eye_ray(uint place) {
  uint row = quotient(place, dispatch.tile.z);
  uint x = dispatch.tile.x + place - row * dispatch.tile.z;
  uint y = dispatch.tile.y + row;
  Frame frame = load_frame();
  return camera_ray(frame, sample_place(frame, x, y, dispatch.sample_index.x));
}
#endif

#ifdef PACKET_SHADOW
// The surface that the eye ray at `place` hits, as its viewer sees it; struck: whether there is one.
Surface seen_at(uint place, OUT(bool) struck) {
  uvec4 counts = uvec4(0u, 0u, 0u, 0u);
  uint there = place == NONE ? 0u : place;
  Hit hit = hit_of_packet(hits[there], counts);
  struck = place != NONE && hit.slot != NONE;
  hit.slot = struck ? hit.slot : 0u;
  Ray ray = eye_ray(there);
  Surface surface = surface_at(primitive_at(hit), ray, hit);
  return face_viewer(surface, dot3(ray.d, surface.normal_geometric) < 0.0f);
}
#endif

void main() {
  uint group = dealt_out(gl_WorkGroupID.x, gl_NumWorkGroups.x, GROUP_STRIDE);
  uint packet = group * (64u / LANES) + gl_SubgroupID;
  uint lane = gl_SubgroupInvocationID;
  uint place[RAYS_A_LANE];
  EACH place[k] = place_of(packet, uint(k) * LANES + lane);

#ifdef PACKET_SHADOW
  Surface seen[RAYS_A_LANE];
  bool struck[RAYS_A_LANE];
  EACH seen[k] = seen_at(place[k], struck[k]);
  uint light = 0u;
  do {
    // A ray for which nothing is asked meets nothing, but must be one.
    EACH {
      LightSample to = sample_light(load_light(light), seen[k].p);
      bool lit = struck[k] && dot3(seen[k].normal, to.direction) > 0.0f &&
                 dot3(seen[k].normal_geometric, to.direction) > 0.0f;
      ray[k] = lit ? leave(seen[k], to.direction) : make_ray(vec3(0.0f, 0.0f, 0.0f), vec3(1.0f, 0.0f, 0.0f));
      found[k] = nothing_found(lit ? to.distance : -1.0f);
      meet_loose(found[k], ray[k], true);
    }
    walk_together(lane);
    EACH {
      if (place[k] != NONE) occlusions[light * dispatch.sample_index.z + place[k]] = found[k].occluded;
    }
    light += 1u;
  } while (light < LIGHT_COUNT);
  uint flags = loops_cut_off(LOOP_PROBE);
  EACH {
    if (place[k] != NONE) hits[place[k]].hit.w = hits[place[k]].hit.w | flags;
  }
#else
  EACH {
#ifdef PACKET_PRIMARY
    ray[k] = eye_ray(place[k] == NONE ? 0u : place[k]);
    found[k] = nothing_found(place[k] == NONE ? -1.0f : T_MISS);
#else
    QueryRay asked = rays[place[k] == NONE ? 0u : place[k]];
    ray[k] = make_ray(vec3(asked.origin), vec3(asked.direction));
    found[k] = nothing_found(place[k] == NONE ? -1.0f : minimum(asked.direction.w, T_MISS));
#endif
    meet_loose(found[k], ray[k], ANY);
  }
  walk_together(lane);
  uint flags = loops_cut_off(LOOP_PROBE);
  EACH {
    if (place[k] != NONE) {
#ifdef PACKET_PRIMARY
      hits[place[k]] = packet_of_hit(found[k].hit, flags);
#else
      results[place[k]] = answer(found[k], ANY, flags);
#endif
    }
  }
#endif
}
