// Union, intersection and difference of closed shapes, its leaves.
// extra: how many nodes; as bits the subtracted leaves; how many leaves; as bits those of deferred kinds. Then the nodes, and the leaves by
// kind in registry order: each a Primitive, the centre of its bounds and half of their size.
// A node: its operands as bits, leaves and nodes before it, and whether it is within all of them or within any. Outside of a
// subtracted leaf counts as within it. The last node is the CSG object.
#ifndef CSG_GLSL
#define CSG_GLSL
#include "geometry/edges.glsl"
#include "records.h"

SHADER_BEGIN

#if HAS_CSG
vec3 csg_center(Primitive s) { return vec3(s.a); }  // center of its bounds
vec3 csg_half_size(Primitive s) { return vec3(s.b); }

#define LEAF_WORDS 6u
#define MOST_LEAVES 32

struct CsgHit {
  float t;       // T_NONE where there is none
  uint leaf;     // whose surface it is
  float after;   // where the crossing before was, of any leaf
  uint side;     // on which the ray was of the leaf
  uint optical_depth;  // optical depth of all surfaces on the way, the greatest
  bool iteration_limit;  // a leaf did not find its next crossing: beyond `after` nothing is sure
};

uint csg_leaf_at(Primitive s, uint leaf) { return s.extra + 1u + load_outline(s.extra).x + LEAF_WORDS * leaf; }

Primitive load_leaf(uint at) {
  return primitive_of(load_outline(at), bits_to_floats(load_outline(at + 1u)), bits_to_floats(load_outline(at + 2u)),
                      bits_to_floats(load_outline(at + 3u)));
}

// True if the ray passes a box at t > 0. The room is as in geometry/outline.glsl.
bool passes_box(Ray ray, vec3 box_centre, vec3 half_size) {
  vec3 centre = box_centre - ray.o;
  float room = 16.0f * EPSILON * max_component(abs3(centre) + half_size);
  vec3 middle = centre * ray.inverse;
  vec3 reach = abs3(ray.inverse) * (half_size + vec3(room, room, room));
  float exit = -max_component(-middle - reach);
  return exit > 0.0f && max_component(middle - reach) <= exit;
}

uint node_holds(uvec4 node, uint literals, uint values) {
  uint of_leaves = literals & node.x;
  uint of_nodes = values & node.y;
  return (node.z != 0u ? of_leaves == node.x && of_nodes == node.y : (of_leaves | of_nodes) != 0u) ? 1u : 0u;
}

// For each of two points, 1 if it is within the CSG object. `literals`: the leaves that contain each point, and the subtracted leaves that do not.
uvec2 csg_holds(uint at, uint nodes, uvec2 literals) {
  uvec2 values = uvec2(0u, 0u);
  uvec2 value = uvec2(0u, 0u);
  for (uint i = 0u; i < nodes; i++) {
    uvec4 node = load_outline(at + i);
    value = uvec2(node_holds(node, literals.x, values.x), node_holds(node, literals.y, values.y));
    values = uvec2(values.x | value.x << i, values.y | value.y << i);
  }
  return value;
}

// The next crossings of a ray with a leaf.
struct LeafCrossings {
  float next;    // where it does at t > 0; 0: the leaf's search reached its iteration limit; below 0: to be queried again, from `passed` on
  float second;  // where it does after that, negative where more may come; 0 where that is not known
  bool inside;   // until `next`; where that is below 0, from `passed` on
  float passed;
};

// The t of the ray's next crossing of the queried leaf.
float leaf_crossing(float t, Ray ray) {
  // A ray within the leaf leaves it, perhaps at once.
  float otherwise = ray.side == SIDE_INSIDE ? ray.after : T_MISS;
  return t > ray.after ? t : otherwise;
}

Ray beyond(Ray ray, float t) {
  Ray r = ray;
  r.after = t;
  r.side = SIDE_OUTSIDE + SIDE_INSIDE - ray.side;
  return r;
}

// Three crossings of a leaf of an immediate kind, for most of the work is the same: so one call finds all of a convex one.
LeafCrossings test_immediate(Primitive leaf, Ray ray) {
  float t0 = T_MISS;
  float t1 = T_MISS;
  float t2 = T_MISS;
#define ASK_THRICE(name, number)                                     \
  if (kind_of(leaf) == number) {                                     \
    vec2 uv;                                                         \
    t0 = leaf_crossing(name##_intersect(leaf, ray, uv), ray);        \
    Ray second = beyond(ray, t0);                                    \
    t1 = leaf_crossing(name##_intersect(leaf, second, uv), second);  \
    Ray third = beyond(second, t1);                                  \
    t2 = leaf_crossing(name##_intersect(leaf, third, uv), third);    \
  }
  IMMEDIATE_LEAVES(ASK_THRICE)
  bool last = t2 == T_MISS;
  bool outside = ray.side == SIDE_OUTSIDE;
  LeafCrossings all;
  all.next = t0 > 0.0f ? t0 : t1 > 0.0f ? t1 : t2 > 0.0f ? t2 : T_NONE;
  all.second = t0 > 0.0f ? (last ? t1 : -t1) : t1 > 0.0f ? (last ? t2 : -t2) : 0.0f;
  all.inside = outside != (t0 > 0.0f || (!(t1 > 0.0f) && t2 > 0.0f));
  all.passed = t2;
  return all;
}

#if HAS_DEFERRED_LEAVES
// The next crossing of a leaf whose kind searches for it.
LeafCrossings test_deferred(Primitive leaf, Ray ray) {
  float t = T_MISS;
#define ASK_ONCE(name, number)                 \
  if (kind_of(leaf) == number) {               \
    vec2 uv;                                   \
    t = name##_intersect(leaf, ray, uv);       \
  }
  DEFERRED_LEAVES(ASK_ONCE)
  bool limit = t == T_ITERATION_LIMIT;
  t = leaf_crossing(t, ray);
  bool outside = ray.side == SIDE_OUTSIDE;
  LeafCrossings all;
  all.next = limit ? 0.0f : t > 0.0f ? t : T_NONE;
  all.second = 0.0f;
  all.inside = outside != (t > 0.0f);
  all.passed = t;
  return all;
}
#endif

// Follows the ray from t = −∞, outside of all closed shapes. It goes past each leaf's crossings up to t = 0. Then it follows the crossings
// of all leaves to the first at which it enters or leaves the CSG object, and on to one that weakens a shadow ray by `enough`. So no query begins
// where a ray starts. A leaf is queried again only where the ray has crossed its answer. All leaves that are crossed at the same t are crossed at once.
CsgHit csg_traverse(Primitive s, Ray ray, float t_max, uint enough) {
  uvec4 head = load_outline(s.extra);
  uint nodes = s.extra + 1u;
  uint leaves = nodes + head.x;
  CsgHit hit;
  hit.t = 0.0f;
  hit.leaf = 0u;
  hit.after = 0.0f;
  hit.side = SIDE_OUTSIDE;
  hit.optical_depth = 0u;
  hit.iteration_limit = false;

  // The leaves that the ray comes near to, as bits.
  uint near = 0u;
  uint bit = 1u;
  uint end = passes_box(ray, csg_center(s), csg_half_size(s)) ? leaves + LEAF_WORDS * head.z : leaves;
  for (uint at = leaves; at < end; at += LEAF_WORDS) {
    near = passes_box(ray, vec3(bits_to_floats(load_outline(at + 4u))), vec3(bits_to_floats(load_outline(at + 5u)))) ? near | bit : near;
    bit = bit << 1u;
  }

  // LeafCrossings of each; next_crossing is negative while the ray is inside.
  float next_crossing[MOST_LEAVES];
  float second_crossing[MOST_LEAVES];
  uint requested = near;
  uint inside = 0u;
  float from = T_NONE;
  bool going = near != 0u;
  do {
    // Query each list, one after the other whatever their kinds, until the answer is at t > 0. Tested at the bottom, which saves an iteration with
    // all lanes idle: the results are in the arrays (docs/lavapipe.md).
#define ASK(ask, which)                                                                                     \
    {                                                                                                       \
      uint todo = requested & (which);                                                                      \
      float after = from;                                                                                   \
      uint within = inside;                                                                                 \
      do {                                                                                                  \
        if (todo != 0u) {                                                                                   \
          uint i = lowest_bit(todo);                                                                        \
          uint one = todo & (~todo + 1u);                                                                   \
          Ray r = ray;                                                                                      \
          r.after = after;                                                                                  \
          r.side = (within & one) != 0u ? SIDE_INSIDE : SIDE_OUTSIDE;                                       \
          LeafCrossings all = ask(load_leaf(leaves + LEAF_WORDS * i), r);                                   \
          bool known = all.next >= 0.0f;                                                                    \
          if (known) {                                                                                      \
            next_crossing[i] = all.inside ? -all.next : all.next;                                           \
            second_crossing[i] = all.second;                                                                \
          }                                                                                                 \
          todo = known ? todo ^ one : todo;                                                                 \
          after = known ? from : all.passed;                                                                \
          within = all.inside ? within | one : within & ~one;                                               \
        }                                                                                                   \
      } while (todo != 0u);                                                                                 \
    }
    ASK(test_immediate, ~head.w)
#if HAS_DEFERRED_LEAVES
    ASK(test_deferred, head.w)
#endif

    // Cross leaves, as long as the crossings are known. Tested at the top: its results stay for rays that are done with the loop around.
    requested = 0u;
    for (; going && requested == 0u;) {
      float next = T_MISS;
      uint crossed = 0u;
      inside = 0u;
      for (uint rest = near; rest != 0u; rest = rest & (rest - 1u)) {
        uint one = rest & (~rest + 1u);
        float crossing = next_crossing[lowest_bit(rest)];
        float t = abs(crossing);
        inside = crossing < 0.0f ? inside | one : inside;
        crossed = t < next ? one : t == next ? crossed | one : crossed;
        next = minimum(t, next);
      }

      // The surface is that of the first leaf whose crossing brings the ray to where it is then.
      uint literals = (inside ^ crossed) ^ head.y;
      uvec2 holds = csg_holds(nodes, head.x, uvec2(inside ^ head.y, literals));
      hit.iteration_limit = next == 0.0f;
      bool boundary = holds.x != holds.y && next < t_max && !hit.iteration_limit;
      uint changed = crossed & (holds.y != 0u ? literals : ~literals);
      uint first = boundary ? changed & (~changed + 1u) : 1u;
      hit.leaf = lowest_bit(first);
      uint optical_depth = boundary ? load_outline(leaves + LEAF_WORDS * hit.leaf).z : 0u;
      hit.optical_depth = optical_depth > hit.optical_depth ? optical_depth : hit.optical_depth;
      hit.side = (inside & first) != 0u ? SIDE_INSIDE : SIDE_OUTSIDE;
      hit.after = hit.t;
      hit.t = next;
      from = next;
      inside = inside ^ crossed;
      going = next < t_max && !hit.iteration_limit && !(boundary && hit.optical_depth >= enough);

      for (uint rest = going ? crossed : 0u; rest != 0u; rest = rest & (rest - 1u)) {
        uint one = rest & (~rest + 1u);
        uint i = lowest_bit(rest);
        float second = second_crossing[i];
        requested = second == 0.0f ? requested | one : requested;
        next_crossing[i] = (inside & one) != 0u ? -abs(second) : abs(second);
        second_crossing[i] = second < 0.0f ? 0.0f : T_MISS;
      }
    }
  } while (going);
  hit.t = hit.t > 0.0f && hit.t < T_MISS ? hit.t : T_NONE;
  return hit;
}

// uv: the leaf and the ray's side of it, and `after`, from which the leaf will find its own uv.
float csg_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  CsgHit hit = csg_traverse(s, ray, T_MISS, 0u);
  uv = hit.iteration_limit ? vec2(hit.after, 0.0f) : vec2(float(4u * hit.leaf + hit.side), hit.after);
  return hit.iteration_limit ? T_ITERATION_LIMIT : hit.t;
}

// The optical depth of a shadow ray before t_max: that of the densest surface on its way.
uint csg_optical_depth(Primitive s, Ray ray, float t_max) { return csg_traverse(s, ray, t_max, s.optical_depth).optical_depth; }

bool csg_reject(Primitive s, Ray ray) { return !passes_box(ray, csg_center(s), csg_half_size(s)); }

void csg_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  lower = csg_center(s) - csg_half_size(s);
  upper = csg_center(s) + csg_half_size(s);
}

// The leaf whose surface was hit.
Primitive csg_leaf(Primitive s, Hit hit) { return load_leaf(csg_leaf_at(s, uint(hit.uv.x) >> 2u)); }

vec4 leaf_level(Primitive leaf, vec3 p) {
  vec4 level = vec4(0.0f, 0.0f, 0.0f, T_MISS);
#define LEAF_LEVEL(name, number) \
  if (kind_of(leaf) == number) level = name##_level(leaf, p);
  CLOSED_SHAPES(LEAF_LEVEL)
  return level;
}

// True if the leaf `own`, as a bit, bounds the CSG object where the ray is within the leaves `within`.
bool bounds_csg(Primitive s, uint own, uint within) {
  uvec4 head = load_outline(s.extra);
  uvec2 holds = csg_holds(s.extra + 1u, head.x, uvec2((within | own) ^ head.y, (within & ~own) ^ head.y));
  return holds.x != holds.y;
}

#define CLEARING_STEPS 8u
#define MOST_TURNED 0.00390625f  // the squared sine of 3.6°

// w: the distance that is missing to be `room` on the inner side of a level. xyz: its gradient along a surface of unit normal n.
vec4 missing_part(vec4 level, vec3 n, float room) {
  float steep = sqrt(dot3(vec3(level), vec3(level)));
  vec3 gradient = steep > 0.0f ? vec3(level) / steep : vec3(0.0f, 0.0f, 0.0f);
  return vec4(gradient - n * dot3(gradient, n), steep > 0.0f ? level.w / steep + room : 0.0f);
}

// The shortest step along the surface after which neither is missing, or a part of it that is `longest`.
vec3 step_inside(vec4 first, vec4 second, float longest) {
  vec3 a = vec3(first);
  vec3 b = vec3(second);
  float aa = maximum(dot3(a, a), 0.015625f);
  float bb = maximum(dot3(b, b), 0.015625f);
  float ab = dot3(a, b);
  vec3 step = a * (-first.w / aa);
  if (second.w + dot3(b, step) > 0.0f) {
    float determinant = maximum(aa * bb - ab * ab, 0.015625f * aa * bb);
    step = a * ((second.w * ab - first.w * bb) / determinant) + b * ((first.w * ab - second.w * aa) / determinant);
  }
  return step * minimum(1.0f, longest / sqrt(maximum(dot3(step, step), 1.0e-30f)));
}

// `surface` of the leaf `own`, as a bit, with the parts that surfaces of other leaves add to `inward`, where they cut it.
Surface clear_of_leaves(Primitive s, Surface surface, Ray ray, uint own) {
  uvec4 head = load_outline(s.extra);
  uint leaves = s.extra + 1u + head.x;
  vec3 p = surface.p;
  float room = edge_room(ray, 2.0f * max_component(abs3(p)) + max_component(abs3(csg_center(s)) + csg_half_size(s)), surface.offset);

  // The leaves that p is within, and those whose surface is near.
  uint within = 0u;
  uint near = 0u;
  uint bit = 1u;
  for (uint at = leaves; at < leaves + LEAF_WORDS * head.z; at += LEAF_WORDS) {
    vec3 beyond = abs3(p - vec3(bits_to_floats(load_outline(at + 4u)))) - vec3(bits_to_floats(load_outline(at + 5u)));
    if (bit != own && max_component(beyond) < room) {
      vec4 level = leaf_level(load_leaf(at), p);
      within = level.w < 0.0f ? within | bit : within;
      near = abs(level.w) < 2.0f * room * sqrt(dot3(vec3(level), vec3(level))) ? near | bit : near;
    }
    bit = bit << 1u;
  }

  // Rounding may have taken p to the other side of a surface that is near, where `own` is no surface of the CSG object.
  for (uint rest = near; rest != 0u && !bounds_csg(s, own, within); rest = rest & (rest - 1u)) {
    uint one = rest & (~rest + 1u);
    within = bounds_csg(s, own, within ^ one) ? within ^ one : within;
  }

  // Each step leads to the inside of the surface for which most is missing, and keeps inside of the one before. It ends on the leaf's own
  // surface.
  Surface clear = surface;
  vec3 n = surface.normal_geometric;
  Primitive leaf = load_leaf(leaves + LEAF_WORDS * lowest_bit(own));
  vec3 inward = surface.inward;
  vec4 before = vec4(0.0f, 0.0f, 0.0f, -T_MISS);
  float least = T_MISS;
  for (uint i = 0u; near != 0u && i < CLEARING_STEPS; i++) {
    // Some way in, the leaf's level is that of the face beyond a near edge. It is extended from there to the surface.
    vec4 edge = leaf_level(leaf, p + inward - n * (4.0f * room));
    vec4 worst = missing_part(edge + vec4(0.0f, 0.0f, 0.0f, dot3(vec3(edge), n) * 4.0f * room), n, room);
    worst.w = dot3(vec3(worst), vec3(worst)) > 0.015625f ? worst.w : 0.0f;
    for (uint rest = near; rest != 0u; rest = rest & (rest - 1u)) {
      vec4 level = leaf_level(load_leaf(leaves + LEAF_WORDS * lowest_bit(rest)), p + inward);
      vec4 missing = missing_part((within & rest & (~rest + 1u)) != 0u ? level : -level, n, room);
      worst = missing.w > worst.w ? missing : worst;
    }
    if (worst.w < least) clear.inward = inward;
    least = minimum(worst.w, least);
    vec3 step = worst.w > 0.0f ? step_inside(worst, before, 4.0f * room) : vec3(0.0f, 0.0f, 0.0f);
    before = vec4(vec3(worst), worst.w + dot3(vec3(worst), step));
    inward = inward + step;
    // A surface that bends much turns away from the rays that start there: then the step is shorter.
    vec4 level = leaf_level(leaf, p + inward);
    float steep = dot3(vec3(level), n);
    float turned = 1.0f - steep * steep / dot3(vec3(level), vec3(level));
    if (turned < 0.25f) {
      float part = sqrt(MOST_TURNED / maximum(turned, MOST_TURNED));
      inward = inward * part - n * (level.w * part * part / steep);
    }
  }
  return clear;
}

// A leaf's normal n, turned a little where the ray grazes the leaf and rounding let n be on the other side of d than the crossing was.
vec3 crossed_normal(vec3 n, vec3 d, uint side) {
  float across = dot3(n, d);
  float least = (side == SIDE_OUTSIDE ? -1.0e-6f : 1.0e-6f) * sqrt(dot3(d, d));
  bool wrong = side == SIDE_OUTSIDE ? across > least : across < least;
  return wrong ? normalize3(n - d * ((across - least) / dot3(d, d))) : n;
}

Surface csg_surface(Primitive s, Ray ray, Hit hit) {
  uint leaf = uint(hit.uv.x);
  Primitive primitive = csg_leaf(s, hit);
  Ray r = ray;
  r.after = hit.uv.y;
  r.side = leaf & 3u;
  Hit own = hit;
  Surface surface = no_surface();
#define LEAF_SURFACE(name, number)                                           \
  if (kind_of(primitive) == number) {             \
    name##_intersect(primitive, r, own.uv);                                  \
    surface = name##_surface(primitive, ray, own);                           \
  }
  CLOSED_SHAPES(LEAF_SURFACE)
  surface.normal_geometric = crossed_normal(surface.normal_geometric, ray.d, r.side);
  surface.normal = crossed_normal(surface.normal, ray.d, r.side);
  surface = clear_of_leaves(s, surface, ray, 1u << (leaf >> 2u));

  // A subtracted leaf is seen from within.
  if (((load_outline(s.extra).y >> (leaf >> 2u)) & 1u) != 0u) {
    surface.normal_geometric = -surface.normal_geometric;
    surface.normal = -surface.normal;
  }
  return surface;
}
#endif

SHADER_END
#endif
