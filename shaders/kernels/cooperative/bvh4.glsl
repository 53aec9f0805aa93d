// Incoherent rays, four lanes a ray. Lane i tests child i of a node of four, or primitive i of a leaf, and the stack is spread over
// the lanes: so rays, which diverge, hold up fewer others, for fewer steps. Before that, a group of rays goes down as one for as long
// as most of it takes the same way.
// A ray's hit is the one that `search` finds (bvh/traverse.glsl), since neither depends on the order.
//   ANY                  whether any hit will do
//   load_bvh4_child(i)   the entry has the nodes
#ifndef BVH4_GLSL
#define BVH4_GLSL
#include "bvh/traverse.glsl"

#define STACK_ROWS ((BVH4_STACK_SIZE + 3) / 4)
#define FAR_AWAY 0x7fffffffu
// Rays that go down together at first and then take turns, one a lane; so many at once.
#define GROUP (SUBGROUP_SIZE > 4 ? 8u : 4u)
#define AT_ONCE (GROUP / 4u)
// The number of a ray's waiting children that the common way down may leave behind: whole rows of the stack.
#define WAITING_ROWS (STACK_ROWS < 2 ? STACK_ROWS : 2)
#define WAITING (4 * WAITING_ROWS)
// The common way ends where fewer of a group go on to the same child.
#define TOGETHER (SUBGROUP_SIZE > 4 ? 5u : 3u)
#define EACH_WAITING [[unroll]] for (int i = 0; i < WAITING; i++)
#define EACH_ROW [[unroll]] for (int i = 0; i < STACK_ROWS; i++)

uint lane;    // the lane's number among the ray's four
uint first;   // the subgroup's lane where these four begin
uint member;  // the lane's number in its group
uint group;   // the subgroup's lane where it begins
uint source;  // the lane whose ray these four trace

void find_group(uint invocation) {
  lane = invocation & 3u;
  first = invocation & ~3u;
  member = invocation & (GROUP - 1u);
  group = invocation & ~(GROUP - 1u);
}

uint from_lane(uint x, uint i) { return subgroupShuffle(x, first | i); }
uvec3 from_lane(uvec3 v, uint i) { return uvec3(from_lane(v.x, i), from_lane(v.y, i), from_lane(v.z, i)); }
uint from_member(uint x, uint i) { return subgroupShuffle(x, group | i); }
uint of_source(uint x) { return subgroupShuffle(x, source); }
float of_source(float x) { return subgroupShuffle(x, source); }
vec2 of_source(vec2 v) { return vec2(of_source(v.x), of_source(v.y)); }
vec3 of_source(vec3 v) { return vec3(of_source(v.x), of_source(v.y), of_source(v.z)); }
uvec3 of_source(uvec3 v) { return uvec3(of_source(v.x), of_source(v.y), of_source(v.z)); }

// The least x of the four lanes.
int least(int x) {
  x = lesser(x, subgroupShuffleXor(x, 1u));
  return lesser(x, subgroupShuffleXor(x, 2u));
}
uint least(uint x) {
  uint y = subgroupShuffleXor(x, 1u);
  x = y < x ? y : x;
  y = subgroupShuffleXor(x, 2u);
  return y < x ? y : x;
}
uint sum(uint x) {
  x += subgroupShuffleXor(x, 1u);
  return x + subgroupShuffleXor(x, 2u);
}
uint sum_of_group(uint x) {
  x = sum(x);
#if SUBGROUP_SIZE > 4
  x += subgroupShuffleXor(x, 4u);
#endif
  return x;
}

// The ray of these four lanes. The result is this lane's hit, and `limit` the nearest of all four.
Ray ray;
BoxRay boxes;
TraversalState state;
int limit;
uint at;
// There is room for the most that can wait in this BVH (pack/collapse.cpp).
#define STACK_LANES 4u
#include "kernels/cooperative/lane_stack.glsl"

void visit_node() {
  bool here = at < LEAF;
  // For a leaf, visits the root with a limit that nothing hits: selects cost less than branches, and a minimum less than a select.
  uvec4 c = load_bvh4_child(4u * uint(greater(int(at), 0)) + lane);
  Child child = coded_child(c, boxes);
  int bound = here ? limit : -1;
  bound = c.w == NONE ? -1 : bound;
  int entry = entry_of(child, boxes);
  bool hits = entry <= exit_of(child, boxes, bound);

  // Go to the nearest child that is hit, or to the waiting one.
  uint key = hits ? (uint(entry) & ~3u) | lane : FAR_AWAY;
  uint nearest = least(key);
  bool some = nearest != FAR_AWAY;
  uint child_hit = from_lane(c.w, nearest & 3u);
  uint top = from_lane(stack[0], 0u);
  at = some ? child_hit : here ? top : at;

  // Sort the others onto the stack. rank: twice the number of lanes whose child is nearer; order: the lane of each rank, two bits
  // each, and above them how many there are.
  uint rank = 0u;
  [[unroll]] for (uint i = 1u; i < 4u; i++) rank += from_lane(key, (lane + i) & 3u) < key ? 2u : 0u;
  uint order = sum(hits ? (lane << rank) + 0x1000000u : 0u);
  uint waits = from_lane(c.w, (order >> (2u * lane + 2u)) & 3u);
  move_stack(some ? (order >> 24u) - 1u : 0u, here && !some ? 1u : 0u, waits);
}

void visit_leaf() {
  bool here = at >= LEAF && at != TRAVERSAL_DONE;
  bool mine = here && lane <= (at & 7u);
  uint slot = mine ? ((at & ~LEAF) >> 3u) + lane : 0u;
  Primitive primitive = load_primitive(slot);
  vec2 uv = vec2(0.0f, 0.0f);
  float t = -1.0f;
#define INTERSECT_COOPERATIVELY(name, number) \
  if (BVH_HOLDS(number, primitive)) t = name##_intersect(primitive, ray, uv);
  SHAPES(INTERSECT_COOPERATIVELY)
  t = alpha_test(primitive, primitive.id, NONE, ray, t, uv);
  record_intersection(state, mine ? t : -1.0f, uv, slot, primitive.id, NONE, primitive.optical_depth, ANY);
  uint next = from_lane(stack[0], 0u);
  if (ANY) next = sum(state.occluded) >= OPTICAL_DEPTH_OPAQUE ? TRAVERSAL_DONE : next;
  else limit = least(floatBitsToInt(state.hit.t));
  at = here ? next : at;
  move_stack(0u, here ? 1u : 0u, 0u);
}

// From `at`, with the waiting nodes on the stack.
void traverse_bvh4() {
  // Leaves first: at the end of the common way most rays are at one.
  do {
    do { visit_leaf(); } while (at >= LEAF && at != TRAVERSAL_DONE);
    do { visit_node(); } while (at < LEAF);
  } while (at != TRAVERSAL_DONE);
}

// The nodes that wait for the lane's own ray, the top first.
uint waiting[WAITING];

void push_waiting(bool push, uint value) {
  [[unroll]] for (int i = WAITING - 1; i > 0; i--) waiting[i] = push ? waiting[i > 0 ? i - 1 : 0] : waiting[i];
  waiting[0] = push ? value : waiting[0];
}

void greater_first(inout uint a, inout uint b) {
  uint greatest = a < b ? b : a;
  b = a < b ? a : b;
  a = greatest;
}

// Rays that start close to each other go down the same way at first, whatever their directions: the way to their start. There each
// lane tests all children of one node with its own ray. Returns the node from which the ray must go on by itself.
uint traverse_together(BoxRay own, int own_limit) {
  EACH_WAITING waiting[i] = TRAVERSAL_DONE;
  own.turn = from_lane(own.turn, lane);  // the same, but no longer one of two constants: so the driver makes one rotation of it
  bool on_the_way = own_limit >= 0;
  int room = WAITING;
  uint node = 0u;
  bool go_on;
  do {
    // The children that are hit as bits, and the nearest of them.
    uvec4 c = load_bvh4_child(4u * (node < LEAF ? node : 0u) + lane);
    uint hit_children = 0u;
    uint nearest = FAR_AWAY;
    uint keys[4];
    [[unroll]] for (uint k = 0u; k < 4u; k++) {
      uvec4 one = uvec4(from_member(c.x, k), from_member(c.y, k), from_member(c.z, k), from_member(c.w, k));
      Child child = coded_child(one, own);
      int bound = on_the_way ? own_limit : -1;
      bound = one.w == NONE ? -1 : bound;
      int entry = entry_of(child, own);
      bool hits = entry <= exit_of(child, own, bound);
      uint key = (uint(entry) & ~3u) | k;
      hit_children = hits ? hit_children | (1u << k) : hit_children;
      keys[k] = hits ? key : FAR_AWAY;
      nearest = keys[k] < nearest ? keys[k] : nearest;
      room = hits ? room - 1 : room;
    }
    room += hit_children != 0u ? 1 : 0;

    // Vote for where to go: a byte a child. The top bits count the rays without room for the nodes left behind there: three at most,
    // for one is gone on to, or the ray leaves the way.
    uint votes = hit_children != 0u ? 1u << (8u * (nearest & 3u)) : 0u;
    votes += room < 3 ? 0x10000000u : 0u;
    votes = sum_of_group(votes);
    uint chosen = 0u;
    uint most = votes & 15u;
    [[unroll]] for (uint k = 1u; k < 4u; k++) {
      uint count = (votes >> (8u * k)) & 15u;
      chosen = count > most ? k : chosen;
      most = count > most ? count : most;
    }
    go_on = most >= TOGETHER && votes < 0x10000000u && from_member(c.w, chosen) < LEAF;

    // Leave the others behind, the nearest on top.
    uint mine = go_on ? chosen : nearest & 3u;
    [[unroll]] for (uint k = 0u; k < 4u; k++) keys[k] = k == mine ? FAR_AWAY : keys[k];
    greater_first(keys[0], keys[1]);
    greater_first(keys[2], keys[3]);
    greater_first(keys[0], keys[2]);
    greater_first(keys[1], keys[3]);
    greater_first(keys[1], keys[2]);
    [[unroll]] for (uint k = 1u; k < 4u; k++) push_waiting(keys[k] != FAR_AWAY, from_member(c.w, (keys[k] & 3u)));
    on_the_way = (hit_children & (1u << mine)) != 0u;
    node = from_member(c.w, mine);
  } while (go_on);
  uint start = on_the_way ? node : waiting[0];
  EACH_WAITING waiting[i] = on_the_way ? waiting[i] : i + 1 < WAITING ? waiting[i + 1 < WAITING ? i + 1 : i] : TRAVERSAL_DONE;
  return start;
}

// Each lane brings a ray and gets its answer; in between, its four lanes trace theirs one after the other. Only hits nearer than
// t_max count; a lane without a ray passes −1.
TraversalState trace_cooperatively(Ray own, float t_max) {
  BoxRay own_boxes = box_ray(own, load_bvh(0u));
  TraversalState own_state = traversal_state(t_max);
  intersect_linear_list(own_state, own, ANY);
  uint start = traverse_together(own_boxes, own_state.occluded >= OPTICAL_DEPTH_OPAQUE ? -1 : floatBitsToInt(own_state.hit.t));

  // Rays that trace together should have equal work: order the rays by the number of children that wait for them. `rank`: the number
  // of rays with more. `order`: the member of each position, three bits each.
  uint work = start != TRAVERSAL_DONE ? 1u : 0u;
  EACH_WAITING work += waiting[i] != TRAVERSAL_DONE ? 1u : 0u;
  work = (work << 3u) | member;
  uint rank = 0u;
  [[unroll]] for (uint k = 1u; k < GROUP; k++)
    rank += from_member(work, (member + k) & (GROUP - 1u)) > work ? 1u : 0u;
  uint order = sum_of_group(member << (3u * rank));
  uint with_work = sum_of_group(work > 7u ? 1u : 0u);

  uint turn = 0u;
  do {
    source = group | ((order >> (3u * (turn * AT_ONCE + member / 4u))) & 7u);
    ray.o = of_source(own.o);
    ray.d = of_source(own.d);
    ray.inverse = of_source(own.inverse);
    ray.major = of_source(own.major);
    ray.shear = of_source(own.shear);
#if HAS_BLEND
    ray.alpha_key = of_source(own.alpha_key);
#endif
    boxes.scale = of_source(own_boxes.scale);
    boxes.near = of_source(own_boxes.near);
    boxes.far = of_source(own_boxes.far);
    boxes.turn = of_source(own_boxes.turn);
    state = traversal_state(of_source(own_state.hit.t));
    state.hit.slot = of_source(own_state.hit.slot);
    state.hit.id = of_source(own_state.hit.id);
    state.hit.uv = of_source(own_state.hit.uv);
    uint own_occluded = of_source(own_state.occluded);
    state.occluded = lane == 0u ? own_occluded : 0u;
#if MAY_REACH_ITERATION_LIMIT
    state.sure_until = of_source(own_state.sure_until);
#endif
    limit = floatBitsToInt(state.hit.t);
    at = of_source(start);
    EACH_ROW stack[i] = TRAVERSAL_DONE;
    [[unroll]] for (int i = 0; i < WAITING_ROWS; i++) {
      uint e0 = of_source(waiting[4 * i]);
      uint e1 = of_source(waiting[4 * i + 1]);
      uint e2 = of_source(waiting[4 * i + 2]);
      uint e3 = of_source(waiting[4 * i + 3]);
      stack[i] = lane == 0u ? e0 : lane == 1u ? e1 : lane == 2u ? e2 : e3;
    }
    traverse_bvh4();

    // The lowest id among equally near hits wins, then the lowest uv.x and uv.y, as in `update_closest_hit`. The hit goes back to the lane that had
    // the ray.
    int nearest_t = least(floatBitsToInt(state.hit.t));
    bool nearest = floatBitsToInt(state.hit.t) == nearest_t;
    uint id = least(nearest ? state.hit.id : NONE);
    bool first_of_them = nearest && state.hit.id == id;
    uint u = least(first_of_them ? floatBitsToUint(state.hit.uv.x) : NONE);
#if HAS_PIECES
    first_of_them = first_of_them && floatBitsToUint(state.hit.uv.x) == u;
#endif
    uint v = least(first_of_them ? floatBitsToUint(state.hit.uv.y) : NONE);
#if HAS_PIECES
    first_of_them = first_of_them && floatBitsToUint(state.hit.uv.y) == v;
#endif
    uint slot = least(first_of_them ? state.hit.slot : NONE);
    uint occluded = sum(state.occluded);
    uint tracer = (rank % AT_ONCE) * 4u;
    uint t_back = from_member(uint(nearest_t), tracer);
    uint id_back = from_member(id, tracer);
    uint slot_back = from_member(slot, tracer);
    vec2 uv_back = vec2(uintBitsToFloat(from_member(u, tracer)), uintBitsToFloat(from_member(v, tracer)));
    uint occluded_back = from_member(occluded < OPTICAL_DEPTH_OPAQUE ? occluded : OPTICAL_DEPTH_OPAQUE, tracer);
    bool mine = rank / AT_ONCE == turn;
    own_state.hit.t = mine ? uintBitsToFloat(t_back) : own_state.hit.t;
    own_state.hit.id = mine ? id_back : own_state.hit.id;
    own_state.hit.slot = mine ? slot_back : own_state.hit.slot;
    own_state.hit.uv = mine ? uv_back : own_state.hit.uv;
    own_state.occluded = mine ? occluded_back : own_state.occluded;
#if MAY_REACH_ITERATION_LIMIT
    uint sure_back = from_member(uint(least(floatBitsToInt(state.sure_until))), tracer);
    own_state.sure_until = mine ? uintBitsToFloat(sure_back) : own_state.sure_until;
#endif
    turn += 1u;
  } while (turn * AT_ONCE < with_work);
  return own_state;
}

#endif
