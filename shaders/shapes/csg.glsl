// Union, intersection and difference of closed shapes, its leaves.   a = centre of its bounds    b = half of their size
// extra: how many nodes, as bits the leaves that are taken away, how many leaves; the nodes; the leaves by kind in registry order, each a Primitive,
// the centre of its bounds and half of their size; then a word of no kind.
// A node: its operands as bits, leaves and nodes before it, and whether it is within all of them or within any. Within what is taken away is
// without. The last node is the CSG object.
#ifndef CSG_GLSL
#define CSG_GLSL
#include "geometry/ray.glsl"
#include "records.h"

SHADER_BEGIN

#if HAS_CSG
#define LEAF_WORDS 6u

struct CsgHit {
  float t;       // T_NONE where there is none
  uint leaf;     // whose surface it is
  float after;   // where the crossing before was, of any leaf
  uint side;     // on which the ray was of the leaf
  uint optical_depth;  // of all surfaces on the way, the greatest
  bool iteration_limit;  // a leaf did not find its next crossing: beyond `after` nothing is sure
};

uint csg_leaf_at(Primitive s, uint leaf) { return s.extra + 1u + load_outline(s.extra).x + LEAF_WORDS * leaf; }

Primitive load_leaf(uint at) {
  return primitive_of(load_outline(at), bits_to_floats(load_outline(at + 1u)), bits_to_floats(load_outline(at + 2u)),
                      bits_to_floats(load_outline(at + 3u)));
}

// Whether the ray passes a box at t > 0. The room is as in geometry/outline.glsl.
bool passes_box(Ray ray, vec3 box_centre, vec3 half_size) {
  vec3 centre = box_centre - ray.o;
  float room = 16.0f * EPSILON * max_component(abs3(centre) + half_size);
  vec3 middle = centre * ray.inverse;
  vec3 reach = abs3(ray.inverse) * (half_size + vec3(room, room, room));
  float exit = -max_component(-middle - reach);
  return exit > 0.0f && max_component(middle - reach) <= exit;
}

// Whether a point is within the CSG object. `literals`: the leaves that it is within, and those taken away that it is not.
bool csg_holds(uint at, uint nodes, uint literals) {
  uint values = 0u;
  uint bit = 1u;
  bool value = false;
  for (uint i = 0u; i < nodes; i++) {
    uvec4 node = load_outline(at + i);
    uint of_leaves = literals & node.x;
    uint of_nodes = values & node.y;
    value = node.z != 0u ? of_leaves == node.x && of_nodes == node.y : (of_leaves | of_nodes) != 0u;
    values = value ? values | bit : values;
    bit = bit << 1u;
  }
  return value;
}

// Where the ray next crosses the leaf that it has asked.
float leaf_crossing(float t, Ray ray) {
  // What it is within it leaves, and be it at once.
  float otherwise = ray.side == SIDE_INSIDE ? ray.after : T_MISS;
  return t > ray.after ? t : otherwise;
}

// Follows the ray from t = −∞, where it is outside of all that is closed: past what each leaf crosses up to t = 0, then from crossing to crossing
// of all leaves to the first at which it enters or leaves the CSG object, and on to one that weakens a shadow ray by `enough`. So nothing is ever asked
// where a ray starts. All leaves that are crossed at the same t are crossed at once.
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

  // As bits, the leaves that the ray comes near to, and those that it is inside of.
  uint near = 0u;
  uint inside = 0u;
  uint bit = 1u;
  uint end = passes_box(ray, vec3(s.a), vec3(s.b)) ? leaves + LEAF_WORDS * head.z : leaves;
  for (uint at = leaves; at < end; at += LEAF_WORDS) {
    near = passes_box(ray, vec3(bits_to_floats(load_outline(at + 4u))), vec3(bits_to_floats(load_outline(at + 5u)))) ? near | bit : near;
    bit = bit << 1u;
  }

  // Each round ends farther along, or leaves at the same t what was entered there.
  Ray r = ray;
  float from = T_NONE;
  bool going = near != 0u;
  for (; going;) {
    float next = T_MISS;
    uint crossed = 0u;
    uint at = leaves;
    bit = 1u;
    vec2 uv = vec2(0.0f, 0.0f);
    // Only a loop keeps a driver that runs both sides of every branch from what is not near.
#define CROSS_KIND(name, number)                                                       \
    for (; (load_outline(at).y >> 24u) == number; at += LEAF_WORDS) {                  \
      float t = T_MISS;                                                                \
      r.after = from;                                                                  \
      for (bool behind = (near & bit) != 0u; behind;) {                                \
        r.side = (inside & bit) != 0u ? SIDE_INSIDE : SIDE_OUTSIDE;                    \
        t = name##_intersect(load_leaf(at), r, uv);                                    \
        hit.iteration_limit = hit.iteration_limit || t == T_ITERATION_LIMIT;                                   \
        t = leaf_crossing(t, r);                                                       \
        behind = t <= 0.0f;                                                            \
        inside = behind ? inside ^ bit : inside;                                       \
        r.after = t;                                                                   \
      }                                                                                \
      crossed = t < next ? bit : t == next ? crossed | bit : crossed;                  \
      next = minimum(t, next);                                                         \
      bit = bit << 1u;                                                                 \
    }
    CLOSED_SHAPES(CROSS_KIND)

    // The surface is that of the first leaf whose crossing brings the ray to where it is then.
    uint literals = (inside ^ crossed) ^ head.y;
    bool now = csg_holds(nodes, head.x, literals);
    bool boundary = now != csg_holds(nodes, head.x, inside ^ head.y) && next < t_max;
    uint changed = crossed & (now ? literals : ~literals);
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
  }
  hit.t = hit.t > 0.0f && hit.t < T_MISS ? hit.t : T_NONE;
  return hit;
}

// uv: the leaf and on which side of it the ray was, and `after`, by which the leaf will tell its own.
float csg_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  CsgHit hit = csg_traverse(s, ray, T_MISS, 0u);
  uv = hit.iteration_limit ? vec2(hit.after, 0.0f) : vec2(float(4u * hit.leaf + hit.side), hit.after);
  return hit.iteration_limit ? T_ITERATION_LIMIT : hit.t;
}

// What a shadow ray loses before t_max: as much as the densest surface on its way takes.
uint csg_optical_depth(Primitive s, Ray ray, float t_max) { return csg_traverse(s, ray, t_max, s.optical_depth).optical_depth; }

bool csg_reject(Primitive s, Ray ray) { return !passes_box(ray, vec3(s.a), vec3(s.b)); }

void csg_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  lower = vec3(s.a) - vec3(s.b);
  upper = vec3(s.a) + vec3(s.b);
}

// The leaf whose surface was hit.
Primitive csg_leaf(Primitive s, Hit hit) { return load_leaf(csg_leaf_at(s, uint(hit.uv.x) >> 2u)); }

Surface csg_surface(Primitive s, Ray ray, Hit hit) {
  uint leaf = uint(hit.uv.x);
  Primitive primitive = csg_leaf(s, hit);
  Ray r = ray;
  r.after = hit.uv.y;
  r.side = leaf & 3u;
  Hit own = hit;
  Surface surface = no_surface();
#define LEAF_SURFACE(name, number)                                           \
  for (bool is = kind_of(primitive) == number; is; is = false) {             \
    name##_intersect(primitive, r, own.uv);                                  \
    surface = name##_surface(primitive, ray, own);                           \
  }
  CLOSED_SHAPES(LEAF_SURFACE)

  // What is taken away is seen from within.
  if (((load_outline(s.extra).y >> (leaf >> 2u)) & 1u) != 0u) {
    surface.normal_geometric = -surface.normal_geometric;
    surface.normal = -surface.normal;
  }
  return surface;
}
#endif

SHADER_END
#endif
