// A polygon of the xz plane from y = −1 to y = 1 in object space (geometry/object_space.glsl), |x|, |z| ≤ 1.
//   Parameters: number of walls, height; U, u0 and V, v0 (u = U·(x, z) + u0, v = V·(x, z) + v0 on the caps). Then x, z of each wall's ends; then
//   for each wall u at both ends and the x, z of its unit normal.
#ifndef PRISM_GLSL
#define PRISM_GLSL
#include "geometry/object_space.glsl"

SHADER_BEGIN

// Parameter of a hit: the bottom, the top, or a wall.
#define PRISM_BOTTOM 0.0f
#define PRISM_TOP 1.0f
#define PRISM_WALLS 2.0f

// Seen along y the ray is a line, and the walls are edges that it passes at certain distances, on the way in or out. On which side of the line an
// edge's end lies depends on that end alone, so the line goes out as often as in. It is within the outline where it has gone in more often; so
// the caps use the very distances at which the walls are hit, and no ray passes between them. From inside only a wall on the way out counts, and
// from outside one on the way in: beside an edge of two walls rounding may swap their distances.
float prism_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  ObjectRay r = object_ray(s, ray, 1.7320508f);
  float least = 1.0e-12f * max_component(abs3(r.d));

  // Between the planes of the caps.
  float to_bottom = (-1.0f - r.o.y) * bounded_inverse(r.d.y, least);
  float to_top = (1.0f - r.o.y) * bounded_inverse(r.d.y, least);
  float enter = minimum(to_bottom, to_top);
  float leave = maximum(to_bottom, to_top);

  // The line; any will do for a ray along y.
  float longest = maximum(abs(r.d.x), abs(r.d.z));
  vec2 line = longest < least ? vec2(1.0f, 0.0f) : vec2(r.d.x / longest, r.d.z / longest);
  vec2 per_distance = line / (maximum(longest, least) * (line.x * line.x + line.y * line.y));

  // Only a ray within the bounds tests the walls.
  vec2 inverse = vec2(bounded_inverse(r.d.x, least), bounded_inverse(r.d.z, least));
  vec2 a = (vec2(-1.0f, -1.0f) - vec2(r.o.x, r.o.z)) * inverse;
  vec2 b = (vec2(1.0f, 1.0f) - vec2(r.o.x, r.o.z)) * inverse;
  float near = maximum(enter, maximum(minimum(a.x, b.x), minimum(a.y, b.y)));
  float far = minimum(leave, minimum(maximum(a.x, b.x), maximum(a.y, b.y)));
  uint at = s.extra + OBJECT_PARAMETERS + 3u;
  uint end = near <= far && r.t + far > AFTER(ray) ? at + uint(object_parameters(s).x) : at;

  // The number of entries less that of exits: at the ray's start, and at the caps.
  int depth = 0;
  int depth_at_enter = 0;
  int depth_at_leave = 0;
  float way_in = T_MISS;
  float way_out = T_MISS;
  float wall_in = PRISM_WALLS;
  float wall_out = PRISM_WALLS;
  for (float wall = PRISM_WALLS; at < end; at++, wall += 1.0f) {
    vec4 edge = bits_to_floats(load_outline(at));
    vec2 p = vec2(edge.x - r.o.x, edge.y - r.o.z);
    vec2 q = vec2(edge.z - r.o.x, edge.w - r.o.z);
    float side_p = line.x * p.y - line.y * p.x;
    float side_q = line.x * q.y - line.y * q.x;
    float along_p = per_distance.x * p.x + per_distance.y * p.y;
    float along_q = per_distance.x * q.x + per_distance.y * q.y;
    float distance = (along_p * side_q - along_q * side_p) / (side_q - side_p);
    bool passes_in = side_p > 0.0f && !(side_q > 0.0f);
    bool passes_out = side_q > 0.0f && !(side_p > 0.0f);
    int change = (passes_in ? 1 : 0) - (passes_out ? 1 : 0);
    bool ahead = r.t + distance > AFTER(ray);
    depth_at_enter += distance < enter ? change : 0;
    depth_at_leave += distance < leave ? change : 0;
    depth += ahead ? 0 : change;
    bool between = ahead && distance >= enter && distance < leave;
    bool in_nearer = passes_in && between && distance < way_in;
    bool out_nearer = passes_out && between && distance < way_out;
    way_in = in_nearer ? distance : way_in;
    wall_in = in_nearer ? wall : wall_in;
    way_out = out_nearer ? distance : way_out;
    wall_out = out_nearer ? wall : wall_out;
  }

  bool before = r.t + enter > AFTER(ray);
  bool inside = !before && r.t + leave > AFTER(ray) && depth > 0;
  float cap_in = to_bottom < to_top ? PRISM_BOTTOM : PRISM_TOP;
  float nearest = way_in;
  uv = vec2(wall_in, 0.0f);
  if (before && depth_at_enter > 0) {
    nearest = enter;
    uv.x = cap_in;
  }
  if (inside) {
    bool cap = way_out == T_MISS && depth_at_leave > 0;
    nearest = cap ? leave : way_out;
    uv.x = cap ? PRISM_TOP - cap_in : wall_out;
  }
#if HAS_CSG
  // If it passes two walls at the same t, at a vertex or where the prism is thin, the second one follows at the next representable t.
  bool late = ray.side != SIDE_UNKNOWN && inside != (ray.side == SIDE_INSIDE);
  if (late) return ray.after + (2.0f * EPSILON * abs(ray.after) + 1.0e-37f);
#endif
  return nearest < T_MISS ? r.t + nearest : T_NONE;
}

bool prism_reject(Primitive s, Ray ray) { return false; }

void prism_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { object_box(s, vec3(1.0f, 1.0f, 1.0f), lower, upper); }

// A wall near a point p of the surface: its ends less p, its unit normal, and how near it counts.
struct PrismWall {
  vec3 from;
  vec3 to;
  vec3 n;
  float margin;
  bool near;
};
PrismWall prism_wall(Primitive s, uint i, vec3 p, float room) {
  uint walls = uint(object_parameters(s).x);
  uint first = s.extra + OBJECT_PARAMETERS + 3u;
  vec4 edge = bits_to_floats(load_outline(first + i));
  vec4 more = bits_to_floats(load_outline(first + walls + i));
  PrismWall wall;
  wall.from = vec3(edge.x - p.x, 0.0f, edge.y - p.z);
  wall.to = vec3(edge.z - p.x, 0.0f, edge.w - p.z);
  wall.n = vec3(more.z, 0.0f, more.w);
  wall.margin = room * steepness(s, wall.n);
  vec3 along = wall.to - wall.from;
  along = along / dot3(along, along);
  float share = -dot3(along, wall.from);
  float beyond = 2.0f * room * steepness(s, along);
  wall.near = abs(dot3(wall.n, wall.from)) < 2.0f * wall.margin && share > -beyond && share < 1.0f + beyond;
  return wall;
}

// From a point of a cap to the inside of all walls that it is near to. Twice: at a sharp corner the step away from a wall may lead closer to one before it.
vec3 prism_cap_inward(Primitive s, vec3 p, float room) {
  vec3 inward = vec3(0.0f, 0.0f, 0.0f);
  uint walls = uint(object_parameters(s).x);
  for (uint i = 0u; i < 2u * walls; i++) {
    PrismWall wall = prism_wall(s, i < walls ? i : i - walls, p, room);
    if (wall.near) inward = inward_of_face(inward, vec3(0.0f, 1.0f, 0.0f), -dot3(wall.n, wall.from), wall.n, wall.margin);
  }
  return inward;
}

// From a point of a wall, at `share` of its way `along` from end to end, to the inside of its edges and of the walls that join it at less than 180
// degrees. `n`: its unit normal.
vec3 prism_wall_inward(Primitive s, vec3 p, vec3 n, vec3 along, float share, float room) {
  float squared = dot3(along, along);
  vec3 step = along * (inside_ends(share, 0.0f, 1.0f, room * steepness(s, along / squared)) - share);
  vec3 inward = vec3(0.0f, 0.0f, 0.0f);
  uint walls = uint(object_parameters(s).x);
  for (uint i = 0u; i < walls; i++) {
    PrismWall wall = prism_wall(s, i, p + step, room);
    float rate = dot3(wall.n, along);
    float missing = (dot3(wall.n, inward) - dot3(wall.n, wall.from)) + wall.margin;
    bool meets = minimum(dot3(n, wall.from), dot3(n, wall.to)) < -wall.margin && rate * rate > 0.0009765625f * squared;
    if (wall.near && meets && missing > 0.0f) inward = inward - along * (missing / rate);
  }
  inward = step + inward;
  inward.y = inside_ends(p.y, -1.0f, 1.0f, room * coordinate_steepness(s).y) - p.y;
  return inward;
}

vec4 prism_level(Primitive s, vec3 p) {
  vec3 q = point_into_object(s, p);
  uint at = s.extra + OBJECT_PARAMETERS + 3u;
  uint walls = uint(object_parameters(s).x);
  bool inside = false;
  float nearest = T_MISS;
  vec3 gradient = vec3(0.0f, 1.0f, 0.0f);
  for (uint end = at + walls; at < end; at++) {
    vec4 edge = bits_to_floats(load_outline(at));
    vec4 more = bits_to_floats(load_outline(at + walls));
    vec2 along = vec2(edge.z - edge.x, edge.w - edge.y);
    vec2 from = vec2(q.x - edge.x, q.z - edge.y);
    float share = (from.x * along.x + from.y * along.y) / (along.x * along.x + along.y * along.y);
    vec2 off = from - along * minimum(maximum(share, 0.0f), 1.0f);
    float squared = off.x * off.x + off.y * off.y;
    gradient = squared < nearest ? vec3(more.z, 0.0f, more.w) : gradient;
    nearest = minimum(nearest, squared);
    bool right = from.x * along.y < from.y * along.x;
    inside = inside != ((edge.y > q.z) != (edge.w > q.z) && right != (along.y < 0.0f));
  }
  vec4 wall = level_out_of_object(s, gradient, inside ? -sqrt(nearest) : sqrt(nearest));
  vec4 cap = level_out_of_object(s, vec3(0.0f, q.y < 0.0f ? -1.0f : 1.0f, 0.0f), abs(q.y) - 1.0f);
  return outer_level(wall, cap);
}

Surface prism_surface(Primitive s, Ray ray, Hit hit) {
  vec3 p = at_hit(object_ray(s, ray, 1.7320508f), hit);
  uint first = s.extra + OBJECT_PARAMETERS;
  vec4 sizes = object_parameters(s);
  vec3 gradient = vec3(0.0f, hit.uv.x == PRISM_BOTTOM ? -1.0f : 1.0f, 0.0f);
  UvField field = uv_field(vec2(0.0f, 0.0f), gradient, gradient);
  vec3 way = vec3(0.0f, 0.0f, 0.0f);
  float share = 0.0f;
  bool is_wall = hit.uv.x >= PRISM_WALLS;
  if (!is_wall) {
    vec4 u = bits_to_floats(load_vertex(first + 1u));
    vec4 v = bits_to_floats(load_vertex(first + 2u));
    p.y = gradient.y;
    field = uv_field(vec2(((u.x * p.x + u.y * p.z) + u.z) * gradient.y, (v.x * p.x + v.y * p.z) + v.z),
                     vec3(u.x, 0.0f, u.y) * gradient.y, vec3(v.x, 0.0f, v.y));
  } else {
    uint wall = uint(hit.uv.x - PRISM_WALLS);
    vec4 edge = bits_to_floats(load_outline(first + 3u + wall));
    vec4 more = bits_to_floats(load_outline(first + 3u + uint(sizes.x) + wall));
    vec2 along = vec2(edge.z - edge.x, edge.w - edge.y);
    way = vec3(along.x, 0.0f, along.y);
    share = (along.x * (p.x - edge.x) + along.y * (p.z - edge.y)) / (along.x * along.x + along.y * along.y);
    share = minimum(maximum(share, 0.0f), 1.0f);
    p = vec3(edge.x + along.x * share, minimum(maximum(p.y, -1.0f), 1.0f), edge.y + along.y * share);
    gradient = vec3(more.z, 0.0f, more.w);
    float slope = (more.y - more.x) / (along.x * along.x + along.y * along.y);
    field = uv_field(vec2(more.x + (more.y - more.x) * share, sizes.y * (0.5f * p.y + 0.5f)),
                     vec3(along.x * slope, 0.0f, along.y * slope), vec3(0.0f, 0.5f * sizes.y, 0.0f));
  }
  Surface surface = object_surface(s, p, gradient, field);

  // A wall is where its ends are, and those are rounded however close to the middle it passes.
  surface.offset += 8.0f * EPSILON / steepness(s, gradient);
  float room = object_room(s, ray, p, surface.offset);
  vec3 inward = vec3(0.0f, 0.0f, 0.0f);
  if (is_wall)
    inward = prism_wall_inward(s, p, gradient, way, share, room);
  else
    inward = prism_cap_inward(s, p, room);
  surface.inward = step_out_of_object(s, inward);
  return surface;
}

SHADER_END
#endif
