// Coherent rays, PACKET at a time: the lanes of a subgroup traverse the BVH together, each with several rays. While they are
// far from anything they may hit, they go as one shaft. Then it is the lanes that test different boxes: of a node's children, as
// many as there are lanes (pack/collapse.cpp), or of a leaf's primitives. Only after that are they rays again.
// A ray has the hit that `search` finds (bvh/traverse.glsl), since neither depends on the order.
//   ANY   whether any hit will do
#ifndef PACKET_GLSL
#define PACKET_GLSL
#include "kernels/cooperative/shaft.glsl"
#include "kernels/cooperative/subgroup.glsl"
#include "bvh/traverse.glsl"

#define RAYS_A_LANE (PACKET / SUBGROUP_SIZE)
#define STACK_ROWS ((PACKET_STACK + SUBGROUP_SIZE - 1) / SUBGROUP_SIZE)
#define EACH [[unroll]] for (int k = 0; k < RAYS_A_LANE; k++)
#define EACH_ROW [[unroll]] for (int i = 0; i < STACK_ROWS; i++)

// The work on a shaft before a narrower one is tried: ten times that of the usual one.
#define PATIENCE 512u
// Rays are left out of a shaft that are so many times as far from the first as the others are in the (harmonic) mean.
#define APART 4.0f

uint lane;
Bvh bvh;
Ray ray[RAYS_A_LANE];
TraversalState state[RAYS_A_LANE];
bool waits[RAYS_A_LANE];   // until a shaft has it
bool member[RAYS_A_LANE];  // whether the ray belongs to the shaft
vec2 along[RAYS_A_LANE];   // where on the shaft it starts, and how far along it comes while t grows by 1

Shaft shaft;
float width;    // how far from the shaft's first ray the others are at most
int limit;      // how far along the shaft anything may still be hit, as the bits of a float
uint work;      // done for this shaft, in nodes, leaves and primitives
uint patience;  // the limit on it
uint at;        // the next entry

// A leaf, with a primitive a lane.
uint first_slot;
Primitive mine;
int key;  // the distance along the shaft to its box, and in the last bits the lane; FAR_AWAY if the shaft misses, and once it is tested
// The pairs of this lane's rays and the leaf's primitives that may hit: bit k of each RAYS_A_LANE bits is ray k, and the bits of lane
// 0's primitive are lowest.
uint passing;
bool any_passes() { return in_any_lane(passing != 0u); }

bool any_waits() {
  bool any = false;
  EACH any = any || waits[k];
  return in_any_lane(any);
}

// ---- Which rays make a shaft -----------------------------------------------------------------------------------------------

// A ray from the BVH's origin, permuted, as a line over z.
struct Line {
  uint way;  // along which axis the ray runs: twice its number, 1 more towards lower coordinates
  vec3 p;
  vec2 shear;
};

Line line_of(Ray r) {
  Line line;
  line.way = 2u * r.major + (permute(r.d, r.major).z < 0.0f ? 1u : 0u);
  line.p = permute(r.o - bvh.origin, r.major);
  line.shear = r.shear;
  return line;
}

vec2 at_z(Line line, float z) { return vec2(line.p.x, line.p.y) + line.shear * (z - line.p.z); }
float apart(vec2 a, vec2 b) { return maximum(abs(a.x - b.x), abs(a.y - b.y)); }

// The line of the first ray that waits.
Line first_line() {
  uint first = uint(FAR_AWAY);
  [[unroll]] for (int k = RAYS_A_LANE - 1; k >= 0; k--) first = waits[k] ? uint(k) * LANES + lane : first;
  first = uint(least(int(first)));
  Line line = line_of(ray[0]);
  EACH {
    Line other = line_of(ray[k]);
    bool here = first / LANES == uint(k);
    line.way = here ? other.way : line.way;
    line.p = here ? other.p : line.p;
    line.shear = here ? other.shear : line.shear;
  }
  uint from = first & (LANES - 1u);
  line.way = from_lane(line.way, from);
  line.p = from_lane(line.p, from);
  line.shear = from_lane(line.shear, from);
  return line;
}

// Makes those rays members that run the same way as the first that waits, and no farther than `closeness` from it, where it starts and
// where it leaves the BVH.
void choose_members(Line first, float closeness) {
  float extent = permute(bvh.extent, first.way >> 1u).z;
  bool backward = (first.way & 1u) != 0u;
  float start = backward ? minimum(first.p.z, extent) : maximum(first.p.z, 0.0f);
  float end = backward ? 0.0f : extent;
  float distance[RAYS_A_LANE];
  float inverses = 0.0f;
  float others = 0.0f;
  EACH {
    Line line = line_of(ray[k]);
    distance[k] = maximum(apart(at_z(line, start), at_z(first, start)), apart(at_z(line, end), at_z(first, end)));
    member[k] = waits[k] && line.way == first.way;
    bool other = member[k] && distance[k] > 0.0f;
    inverses += other ? 1.0f / distance[k] : 0.0f;
    others += other ? 1.0f : 0.0f;
  }
  closeness = minimum(closeness, APART * sum(others) / sum(inverses));
  width = 0.0f;
  EACH {
    member[k] = member[k] && !(distance[k] > closeness);
    width = member[k] ? maximum(width, distance[k]) : width;
  }
  width = largest(width);
}

vec2 min_of(vec2 a, vec2 b) { return vec2(minimum(a.x, b.x), minimum(a.y, b.y)); }
vec2 max_of(vec2 a, vec2 b) { return vec2(maximum(a.x, b.x), maximum(a.y, b.y)); }

// Makes a shaft around all members, from where the first of them starts, or the BVH begins, to where the last may hit something.
void make_shaft_of_members(uint way) {
  bool backward = (way & 1u) != 0u;
  float forward = backward ? -1.0f : 1.0f;
  float extent = permute(bvh.extent, way >> 1u).z;
  float reach = 0.0f;
  float z0 = T_MISS;
  float z1 = -T_MISS;
  EACH {
    along[k] = vec2(forward * line_of(ray[k]).p.z, abs(permute(ray[k].d, ray[k].major).z));
    float far = max_component(abs3(ray[k].o - bvh.origin) + bvh.extent);
    reach = member[k] ? maximum(reach, far) : reach;
    z0 = member[k] ? minimum(z0, along[k].x) : z0;
    z1 = member[k] ? maximum(z1, along[k].x + along[k].y * state[k].hit.t) : z1;
  }
  float slack = bvh.slack * largest(reach);
  z0 = maximum(least(z0), backward ? -extent : 0.0f) - slack;
  z1 = maximum(minimum(largest(z1), backward ? 0.0f : extent), z0) + slack;

  vec2 low0 = vec2(T_MISS, T_MISS);
  vec2 low1 = low0;
  vec2 high0 = -low0;
  vec2 high1 = -low0;
  EACH {
    vec2 p0 = at_z(line_of(ray[k]), forward * z0);
    vec2 p1 = at_z(line_of(ray[k]), forward * z1);
    low0 = member[k] ? min_of(low0, p0) : low0;
    low1 = member[k] ? min_of(low1, p1) : low1;
    high0 = member[k] ? max_of(high0, p0) : high0;
    high1 = member[k] ? max_of(high1, p1) : high1;
    along[k] = vec2((along[k].x - z0) / (z1 - z0), along[k].y / (z1 - z0));
  }
  shaft = make_shaft(way >> 1u, forward * z0, forward * z1, least(low0), least(low1), largest(high0), largest(high1), slack);
}

// ---- Going down ------------------------------------------------------------------------------------------------------------

#define STACK_LANES LANES
#include "kernels/cooperative/lane_stack.glsl"

// Keys sort by how far along, and no two are the same.
int make_key(int entry) { return entry == FAR_AWAY ? FAR_AWAY : (entry & ~int(LANES - 1u)) | int(lane); }

void visit_node() {
  bool here = at < LEAF;
  uvec4 c = load_node(PACKET_ROOT + LANES * (here ? at : 0u) + lane);
  vec3 lower = vec3(low_half(c.x), low_half(c.y), low_half(c.z)) * bvh.step;
  vec3 upper = vec3(low_half(c.x >> 16u), low_half(c.y >> 16u), low_half(c.z >> 16u)) * bvh.step;
  int child = here && c.w != NONE ? make_key(entry_of(shaft, lower, upper, limit)) : FAR_AWAY;

  // Go to the nearest child that is hit, or to the waiting one.
  int nearest = least(child);
  bool some = nearest != FAR_AWAY;
  uint top = from_lane(stack[0], 0u);
  at = some ? from_lane(c.w, uint(nearest) & (LANES - 1u)) : here ? top : at;

  // Push the others, the nearest on top: the one that has `rank` nearer ones goes to lane rank − 1.
  uint rank = 0u;
  [[unroll]] for (uint i = 1u; i < LANES; i++) rank += subgroupShuffle(child, (lane + i) & (LANES - 1u)) < child ? 1u : 0u;
  bool pushed = child != FAR_AWAY && rank > 0u;
  uint from = 0u;
#if SUBGROUP_SIZE <= 8
  // By the lanes of each rank, three bits each, and above them how many there are.
  uint order = sum(pushed ? (lane << (3u * rank - 3u)) + 0x1000000u : 0u);
  uint push = order >> 24u;
  from = (order >> (3u * lane)) & (LANES - 1u);
#else
  uint push = sum(pushed ? 1u : 0u);
  [[unroll]] for (uint i = 0u; i < LANES; i++) from = subgroupShuffle(pushed ? rank : NONE, i) == lane + 1u ? i : from;
#endif
  move_stack(push, here && !some ? 1u : 0u, from_lane(c.w, from));
  work += 1u;
}

// True if any ray hits the box.
bool any_hits(vec3 lower, vec3 upper) {
  bool any = false;
  EACH {
    vec3 a = (lower - ray[k].o) * ray[k].inverse;
    vec3 b = (upper - ray[k].o) * ray[k].inverse;
    float near = maximum(maximum(minimum(a.x, b.x), minimum(a.y, b.y)), minimum(a.z, b.z));
    float far = minimum(minimum(maximum(a.x, b.x), maximum(a.y, b.y)), maximum(a.z, b.z));
    int entry = greater(floatBitsToInt(near), 0);
    int exit = lesser(floatBitsToInt(far), floatBitsToInt(state[k].hit.t));
    any = any || (member[k] && entry <= exit);
  }
  return in_any_lane(any);
}

// Goes on to the next waiting node. Leaves in `key` which primitives of this leaf the shaft hits, if any ray hits the box around them.
void visit_leaf() {
  first_slot = (at & ~LEAF) >> 3u;
  bool there = at != TRAVERSAL_DONE && lane <= (at & 7u);
  mine = load_primitive(there ? first_slot + lane : 0u);
  vec3 lower = vec3(0.0f, 0.0f, 0.0f);
  vec3 upper = vec3(0.0f, 0.0f, 0.0f);
#define BOX_OF(name, number) \
  if (BVH_HOLDS(number, mine)) name##_box(mine, lower, upper);
  SHAPES(BOX_OF)
  key = there ? make_key(entry_of(shaft, lower - bvh.origin, upper - bvh.origin, limit)) : FAR_AWAY;
  bool hit = key != FAR_AWAY;
  vec3 slack = vec3(shaft.slack, shaft.slack, shaft.slack);
  vec3 far = vec3(T_MISS, T_MISS, T_MISS);
  bool any = any_hits(least(hit ? lower - slack : far), largest(hit ? upper + slack : -far));
  key = any ? key : FAR_AWAY;

  at = from_lane(stack[0], 0u);
  move_stack(0u, 1u, 0u);
  work += 1u;
}

// The lane of the primitive that is tested next; FAR_AWAY if none is left.
uint next_lane() {
  uint nearest = uint(least(key));
  return nearest == uint(FAR_AWAY) ? nearest : nearest & (LANES - 1u);
}

// Notes which rays may hit the primitive of lane `from`.
void look_at_primitive(uint from) {
  Primitive primitive = from_lane(mine, from & (LANES - 1u));
  uint bits = 0u;
  EACH {
    Ray r = ray[k];
    r.major = shaft.major;  // all members': stated so that a driver permutes vertices once for all rays
    bool rejected = true;
#define REJECT_KIND(name, number) \
    if (BVH_HOLDS(number, primitive)) rejected = name##_reject(primitive, r);
    SHAPES(REJECT_KIND)
    bits = !rejected && member[k] ? bits | (1u << k) : bits;
  }
  passing = from != uint(FAR_AWAY) ? passing | (bits << (uint(RAYS_A_LANE) * from)) : passing;
  key = lane == from ? FAR_AWAY : key;
  work += 1u;
}

// The whole test of one ray with one primitive.
float intersect_primitive(Primitive primitive, Ray r, out vec2 uv) {
  r.major = shaft.major;
  uv = vec2(0.0f, 0.0f);
  float t = -1.0f;
#define INTERSECT_TOGETHER(name, number) \
  if (BVH_HOLDS(number, primitive)) t = name##_intersect(primitive, r, uv);
  SHAPES(INTERSECT_TOGETHER)
  return alpha_test(primitive, primitive.id, NONE, r, t, uv);
}

#if BVH_OF_TRIANGLES
// Intersects the pairs that passed: in each lane one ray with one primitive.
void intersect_passing() {
  bool some = passing != 0u;
  uint lowest = lowest_bit(some ? passing : 1u);
  uint from = lowest / uint(RAYS_A_LANE);
  uint chosen = lowest % uint(RAYS_A_LANE);
  passing = passing & (passing - 1u);
  Primitive primitive = from_lane(mine, from);
  Ray r = ray[0];
  EACH {
    bool here = chosen == uint(k);
    r.o = here ? ray[k].o : r.o;
    r.d = here ? ray[k].d : r.d;
    r.inverse = here ? ray[k].inverse : r.inverse;
    r.shear = here ? ray[k].shear : r.shear;
#if HAS_BLEND
    r.alpha_key = here ? ray[k].alpha_key : r.alpha_key;
#endif
  }
  vec2 uv;
  float t = intersect_primitive(primitive, r, uv);
  t = some ? t : -1.0f;
  EACH record_intersection(state[k], chosen == uint(k) ? t : -1.0f, uv, first_slot + from, primitive.id, NONE, primitive.optical_depth, ANY);
}

// Few rays pass a triangle: they wait until all of the leaf's have been tested.
void visit_leaves() {
  do {
    do { visit_leaf(); } while (next_lane() == uint(FAR_AWAY) && at >= LEAF && at != TRAVERSAL_DONE);
    do { look_at_primitive(next_lane()); } while (next_lane() != uint(FAR_AWAY));
  } while (!any_passes() && at >= LEAF && at != TRAVERSAL_DONE);
  do { intersect_passing(); } while (any_passes());
}
#else
// Intersects all rays with the primitive of lane `from`, the only one with any that pass.
void intersect_passing(uint from) {
  Primitive primitive = from_lane(mine, from & (LANES - 1u));
  uint bits = passing >> (uint(RAYS_A_LANE) * (from & (LANES - 1u)));
  EACH {
    vec2 uv;
    float t = intersect_primitive(primitive, ray[k], uv);
    t = (bits & (1u << k)) != 0u ? t : -1.0f;
    record_intersection(state[k], t, uv, first_slot + from, primitive.id, NONE, primitive.optical_depth, ANY);
  }
  passing = 0u;
}

void visit_leaves() {
  do { visit_leaf(); } while (next_lane() == uint(FAR_AWAY) && at >= LEAF && at != TRAVERSAL_DONE);
  uint from = next_lane();
  do {
    uint tested = from;
    do {
      tested = from;
      look_at_primitive(tested);
      from = next_lane();
    } while (!any_passes() && from != uint(FAR_AWAY));
    intersect_passing(tested);
  } while (from != uint(FAR_AWAY));
}
#endif

void shorten_rays() {
  float farthest = -1.0f;
  EACH {
    // A ray that is wholly in shadow hits nothing more.
    state[k].hit.t = ANY && state[k].occluded >= OPTICAL_DEPTH_OPAQUE ? -1.0f : state[k].hit.t;
    farthest = member[k] && state[k].hit.t > 0.0f ? maximum(farthest, along[k].x + along[k].y * state[k].hit.t) : farthest;
  }
  limit = floatBitsToInt(largest(farthest));
}

// ---- Traversal -------------------------------------------------------------------------------------------------------------

// A driver that runs both sides of every branch can skip only further iterations of a loop. So each loop here goes on until there is
// work for the next, and the first way down stands by itself. Only a packet without a leaf to visit pays for one that it does not need.
void traverse_along_shaft() {
  EACH_ROW stack[i] = TRAVERSAL_DONE;
  limit = FAR_AWAY;
  work = 0u;
  at = 0u;
  passing = 0u;
  do { visit_node(); } while (at < LEAF);
  do {
    do {
      visit_leaves();
      shorten_rays();
      at = work > patience ? TRAVERSAL_DONE : at;
    } while (at >= LEAF && at != TRAVERSAL_DONE);
    do { visit_node(); } while (at < LEAF);
  } while (at != TRAVERSAL_DONE);
}

// Finds the hits of all rays of the packet that are nearer than those found so far.
void traverse_together(uint my_lane) {
  lane = my_lane;
  bvh = load_bvh(0u);
  patience = PATIENCE;
  float closeness = T_MISS;
  EACH waits[k] = state[k].hit.t > 0.0f;
  do {
    uint before[RAYS_A_LANE];
    EACH before[k] = state[k].occluded;
    Line first = first_line();
    choose_members(first, closeness);
    make_shaft_of_members(first.way);
    traverse_along_shaft();

    // A search that took too long is restarted, with rays that are closer to each other and more patience. Hits are kept, sums are not.
    bool done = work <= patience;
    EACH {
      bool again = member[k] && !done && state[k].hit.t > 0.0f;
      state[k].occluded = again ? before[k] : state[k].occluded;
      waits[k] = again || (waits[k] && !member[k]);
    }
    closeness = done ? closeness : 0.5f * width;
    patience = done ? patience : 4u * patience;
  } while (any_waits());
}

#endif
