// Rays and their hits.
#ifndef RAY_GLSL
#define RAY_GLSL
#include "math/math.glsl"
#include "records.h"
#include "textures/context.glsl"

SHADER_BEGIN

// P(t) = o + t·d. The rest follows from d, once for everything that the ray is tested against.
struct Ray {
  vec3 o;
  vec3 d;
  vec3 inverse;  // 1 / d, finite: a component of d so small that it does not count is taken as a little larger
  uint major;    // the axis along which d is longest
  vec2 shear;    // Woop's, the same for every triangle (shapes/triangle.glsl)
#if HAS_INSTANCES
  float reach;   // how far the coordinates reach that the ray was mapped from, in the space that it is in now; 0 in the world
#endif
#if HAS_CSG
  // A ray that seeks the next crossing of a leaf of a CSG object: the t behind which it seeks, and its side of the leaf until then.
  float after;
  uint side;
#endif
#if HAS_BLEND
  uint alpha_key;  // decides, with a primitive's id, whether the ray hits a surface of alpha_mode "blend" (bvh/alpha_test.glsl)
#endif
};

// Queries of `intersect` of closed shapes, so that it serves CSG objects too (shapes/csg.glsl): a crossing is the same number for every caller.
// AFTER: beyond which t it counts. ENTERS: whether of the two crossings of a convex shape the first is asked for, which is at t. COUNTS: whether
// crossings are counted along the whole line; then PASSED: whether that at t has been.
#if HAS_CSG
#define SIDE_UNKNOWN 0u
#define SIDE_OUTSIDE 1u
#define SIDE_INSIDE 2u
#define AFTER(ray) ray.after
#define ENTERS(ray, t) (ray.side == SIDE_UNKNOWN ? (t) > 0.0f : ray.side == SIDE_OUTSIDE)
#define COUNTS(ray) (ray.side != SIDE_UNKNOWN)
#define PASSED(ray, t) (COUNTS(ray) && !((t) > ray.after))
#else
#define AFTER(ray) 0.0f
#define ENTERS(ray, t) ((t) > 0.0f)
#define COUNTS(ray) false
#define PASSED(ray, t) false
#endif

struct Hit {
  float t;        // T_MISS where nothing is hit
  uint slot;      // slot of the primitive, for load_primitive; NONE where nothing is hit
  uint id;        // the scene's primitive index; NONE where nothing is hit
  uint instance;  // that the primitive belongs to; NONE for one of the world's own
  vec2 uv;        // the shape's own parameters
};

// The surface of a shape at the hit.
struct Surface {
  vec3 p;                 // on the surface, projected
  vec3 normal_geometric;  // unit; outward, or by winding
  vec3 normal;            // unit shading normal
#if HAS_BENT_COAT
  vec3 coat_normal;       // … of a clear coat, which only its own normal map bends
#endif
#if HAS_ANISOTROPY
  vec3 rough_axis;        // unit, perpendicular to `normal`: along it microfacets are wider; 0 where no direction is
#endif
#if HAS_SMOOTH
  vec3 normal_side;       // unit, see side_normal; not bent by the material
  vec2 lift;              // lift of a smooth triangle, see geometry/lift.glsl; −1 of any other surface
#endif
  vec2 uv;
  float offset;  // a ray that starts this far off p along the geometric normal does not hit the surface again
  vec3 inward;   // from p to the inside of the surface's edges, where rays start (geometry/edges.glsl); 0 far from edges
  // The values that bent normals need (materials/bent_normal.glsl).
  vec3 u_gradient;  // gradients of u and v at p; components off the surface do not count
  vec3 v_gradient;
  vec4 tangent;  // a mesh's own: along u, and whether v is to the left of that, 1, or to the right, −1; w = 0 where the gradients state it
#if HAS_SECOND_UV
  vec2 second_uv;  // the same of a mesh's second texture coordinates; as above where it has none
  vec3 second_u_gradient;
  vec3 second_v_gradient;
  vec4 second_tangent;
#endif
};

void set_gradients(INOUT(Surface) surface, vec3 u_gradient, vec3 v_gradient) {
  surface.u_gradient = u_gradient;
  surface.v_gradient = v_gradient;
  surface.tangent = vec4(0.0f, 0.0f, 0.0f, 0.0f);
  surface.inward = vec3(0.0f, 0.0f, 0.0f);
#if HAS_SECOND_UV
  surface.second_u_gradient = u_gradient;
  surface.second_v_gradient = v_gradient;
  surface.second_tangent = surface.tangent;
#endif
}

// Sets the gradients from the derivatives of p by u and by v.
void set_tangents(INOUT(Surface) surface, vec3 along_u, vec3 along_v) {
  vec3 n = cross3(along_u, along_v);
  float squared = dot3(n, n);
  vec3 across = squared > 0.0f ? n / squared : n;
  set_gradients(surface, cross3(along_v, across), cross3(across, along_u));
}

Surface no_surface() {
  Surface surface;
  surface.p = vec3(0.0f, 0.0f, 0.0f);
  surface.normal_geometric = surface.p;
  surface.normal = surface.p;
#if HAS_BENT_COAT
  surface.coat_normal = surface.p;
#endif
#if HAS_ANISOTROPY
  surface.rough_axis = surface.p;
#endif
#if HAS_SMOOTH
  surface.normal_side = surface.p;
  surface.lift = vec2(-1.0f, -1.0f);
#endif
  surface.uv = vec2(0.0f, 0.0f);
#if HAS_SECOND_UV
  surface.second_uv = surface.uv;
#endif
  surface.offset = 0.0f;
  set_gradients(surface, surface.p, surface.p);
  return surface;
}

// The point at which the surface's textures are sampled.
TextureContext context_on(Surface surface) {
  TextureContext point = context_of_uv(surface.uv);
#if HAS_SECOND_UV
  point.second_uv = surface.second_uv;
#endif
  point.p = surface.p;
  return point;
}

// uv of a surface that is 1 wide: rounding does not take a point of its border to where the next check begins.
vec2 inner_uv(vec2 uv) { return vec2(minimum(maximum(uv.x, 0.0f), 1.0f - EPSILON), minimum(maximum(uv.y, 0.0f), 1.0f - EPSILON)); }

PacketHit packet_of_hit(Hit hit, uint flags) {
  PacketHit packet;
  packet.t = hit.t;
  packet.slot = hit.slot;
  packet.id = hit.id;
  packet.flags = flags;
  packet.u = hit.uv.x;
  packet.v = hit.uv.y;
  packet.unused_0 = packet.unused_1 = 0u;
  return packet;
}

Hit hit_of_packet(PacketHit packet, INOUT(uvec4) counts) {
  counts.z = counts.z | packet.flags;
  Hit hit;
  hit.t = packet.t;
  hit.slot = packet.slot;
  hit.id = packet.id;
  hit.instance = NONE;
  hit.uv = vec2(packet.u, packet.v);
  return hit;
}

// The last two axes after `major`, then `major` itself.
vec3 permute(vec3 v, uint major) {
  return major == 0u ? vec3(v.y, v.z, v.x) : major == 1u ? vec3(v.z, v.x, v.y) : v;
}

// 1 / x for |x| ≥ least, else 1 / least with the sign of x.
float bounded_inverse(float x, float least) {
  float size = maximum(abs(x), least);
  return 1.0f / (x < 0.0f ? -size : size);
}

Ray make_ray(vec3 o, vec3 d) {
  Ray ray;
  ray.o = o;
  ray.d = d;
  vec3 size = abs3(d);
  ray.major = size.x >= size.y && size.x >= size.z ? 0u : size.y >= size.z ? 1u : 2u;
  vec3 p = permute(d, ray.major);
  ray.shear = vec2(p.x / p.z, p.y / p.z);
#if HAS_INSTANCES
  ray.reach = 0.0f;
#endif
#if HAS_CSG
  ray.after = 0.0f;
  ray.side = SIDE_UNKNOWN;
#endif
#if HAS_BLEND
  ray.alpha_key = 0u;
#endif
  // Over the whole length of the ray, 1e-12 of it is far less than bvh.glsl's margin of boxes.
  float least = 1.0e-12f * abs(p.z);
  ray.inverse = vec3(bounded_inverse(d.x, least), bounded_inverse(d.y, least), bounded_inverse(d.z, least));
  return ray;
}

// A ray from o in direction d that hits the same blended surfaces as `ray`: the same line, in another space or from further on.
Ray continue_ray(Ray ray, vec3 o, vec3 d) {
  Ray next = make_ray(o, d);
#if HAS_BLEND
  next.alpha_key = ray.alpha_key;
#endif
  return next;
}

// The normal that decides on which side of the surface a direction is: the interpolated normal of a smooth triangle, the geometric normal of
// any other surface.
vec3 side_normal(Surface s) {
#if HAS_SMOOTH
  return s.normal_side;
#else
  return s.normal_geometric;
#endif
}

// A ray that leaves `s` in direction d, started clear of the surface on the side that d points to. Where d is steep enough the start
// moves along the ray itself, which keeps its line: a step along the normal would shift every refracted ray sideways.
Ray spawn_ray(Surface s, vec3 d) {
  float cosine = dot3(d, s.normal_geometric);
  float side = cosine < 0.0f ? -s.offset : s.offset;
  bool steep = abs(cosine) > 0.125f;
  return make_ray((s.p + s.inward) + (steep ? d * (s.offset / abs(cosine)) : s.normal_geometric * side), d);
}

// True if scattered rays leave it from elsewhere than its points.
bool lifts(Surface s) {
#if HAS_SMOOTH
  return s.lift.x >= 0.0f;
#else
  return false;
#endif
}

// Spawns a ray that the surface scatters to its front, or behind it. It leaves a smooth triangle from the curved surface that the triangle
// stands for, and may point into the triangle's plane from there.
Ray spawn_scattered(Surface s, vec3 d, bool front) {
#if HAS_SMOOTH
  if (s.lift.x >= 0.0f) {
    float up = front ? 1.0f : -1.0f;
    float cosine = dot3(d, s.normal_geometric) * up;
    vec3 off = cosine > 0.125f ? d * (s.offset / cosine) : s.normal_geometric * (up * s.offset);
    return make_ray((s.p + s.inward) + s.normal_side * (up * (front ? s.lift.x : s.lift.y)) + off, d);
  }
#endif
  return spawn_ray(s, d);
}

// Spawns a shadow ray to a light in the unit direction d, `distance` away from s.p. Both change if the ray starts elsewhere.
Ray spawn_to_light(Surface s, vec3 d, bool front, INOUT(float) distance) {
  Ray ray = spawn_scattered(s, d, front);
#if HAS_SMOOTH
  if (s.lift.x >= 0.0f && distance < T_MISS) {
    vec3 way = d * distance - (ray.o - s.p);
    distance = sqrt(dot3(way, way));
    ray = make_ray(ray.o, way / distance);
  }
#endif
  return ray;
}

SHADER_END
#endif
