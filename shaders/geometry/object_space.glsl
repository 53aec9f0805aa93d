// Shapes that are a plain one, such as the unit sphere, in object space.
// extra: the first of its vertices: three with the rows of the map back, then the shape's own parameters
#ifndef OBJECT_SPACE_GLSL
#define OBJECT_SPACE_GLSL
#include "geometry/edges.glsl"
#include "geometry/uv_field.glsl"
#include "records.h"

SHADER_BEGIN

vec3 object_x(Primitive s) { return vec3(s.a); }  // the rows of the linear map from the world into object space
vec3 object_y(Primitive s) { return vec3(s.b); }
vec3 object_z(Primitive s) { return vec3(s.c); }
vec3 object_center(Primitive s) { return vec3(s.a.w, s.b.w, s.c.w); }  // its origin, in the world

#define OBJECT_PARAMETERS 3u  // where those begin

// A ray in object space: at `t + s` of the world's ray it is at o + s·d.
struct ObjectRay {
  vec3 o;
  vec3 d;
  float t;
};

vec3 into_object(Primitive s, vec3 v) { return vec3(dot3(object_x(s), v), dot3(object_y(s), v), dot3(object_z(s), v)); }

// The t at which a ray comes nearest to the centre; and the same ray from there.
float nearest_at(ObjectRay ray) { return -dot3(ray.o, ray.d) / dot3(ray.d, ray.d); }
ObjectRay from_nearest(ObjectRay ray) {
  ObjectRay r = ray;
  float s = nearest_at(ray);
  r.o = r.o + r.d * s;
  r.t = r.t + s;
  return r;
}

// Distances in object space are not the world's, but t and s are. A ray from afar is followed from its point nearest to the centre: values
// computed from there are as small as the shape, so that nothing cancels. In the world first: then the map's effect on the direction's
// rounding does not count on the long way. `reach`: the farthest that the shape's points are from its centre. Without branches, so that
// compilers share the code that all callers need: another kind of leaf of a CSG object, or the same for its next crossing.
ObjectRay object_ray(Primitive s, Ray ray, float reach) {
  vec3 from_center = ray.o - object_center(s);
  ObjectRay r;
  r.o = into_object(s, from_center);
  r.d = into_object(s, ray.d);
  r.t = 0.0f;
  ObjectRay far = r;
  far.t = -dot3(from_center, ray.d) / dot3(ray.d, ray.d);
  far.o = into_object(s, from_center + ray.d * far.t);
  far = from_nearest(far);
  bool is_far = dot3(r.o, r.o) > 4.0f * reach * reach;
  r.t = is_far ? far.t : r.t;
  r.o = is_far ? far.o : r.o;
  // A ray that passes far from the shape misses before squares overflow. So does a direction so short that its squares are lost, as no unit
  // vector's are.
  bool passes = dot3(r.o, r.o) <= 4.0f * reach * reach && dot3(r.d, r.d) >= 1.0e-30f;
  r.o = passes ? r.o : vec3(0.0f, 4.0f * reach, 0.0f);
  r.d = passes ? r.d : vec3(1.0f, 0.0f, 0.0f);
  r.t = passes ? r.t : 0.0f;
  return r;
}

vec3 at_hit(ObjectRay ray, Hit hit) { return ray.o + ray.d * (hit.t - ray.t); }

// The box around all points up to `extent` from the centre of object space along its axes.
void object_box(Primitive s, vec3 extent, OUT(vec3) lower, OUT(vec3) upper) {
  vec4 x = bits_to_floats(load_vertex(s.extra));
  vec4 y = bits_to_floats(load_vertex(s.extra + 1u));
  vec4 z = bits_to_floats(load_vertex(s.extra + 2u));
  vec3 centre = vec3(x.w, y.w, z.w);
  vec3 reach = vec3(dot3(abs3(vec3(x)), extent), dot3(abs3(vec3(y)), extent), dot3(abs3(vec3(z)), extent));
  lower = centre - reach;
  upper = centre + reach;
}

vec4 object_parameters(Primitive s) { return bits_to_floats(load_vertex(s.extra + OBJECT_PARAMETERS)); }

// Gradients map by the transpose.
vec3 gradient_out_of_object(Primitive s, vec3 gradient) {
  return object_x(s) * gradient.x + object_y(s) * gradient.y + object_z(s) * gradient.z;
}

// The world's surface. `p`: on the shape. `gradient`: points outward there, of about the length 1 where the map is extreme.
Surface object_surface(Primitive s, vec3 p, vec3 gradient, UvField field) {
  vec4 x = bits_to_floats(load_vertex(s.extra));
  vec4 y = bits_to_floats(load_vertex(s.extra + 1u));
  vec4 z = bits_to_floats(load_vertex(s.extra + 2u));
  Surface surface;
  surface.p = vec3(dot3(vec3(x), p) + x.w, dot3(vec3(y), p) + y.w, dot3(vec3(z), p) + z.w);

  vec3 n = gradient_out_of_object(s, gradient);
  float slope = sqrt(dot3(n, n));
  surface.normal_geometric = n / slope;
  surface.normal = surface.normal_geometric;
  surface.uv = field.uv;
  set_gradients(surface, gradient_out_of_object(s, field.u_gradient), gradient_out_of_object(s, field.v_gradient));

  // Rounding on the way here, and when a ray that leaves is brought back into object space.
  vec3 size = abs3(p);
  vec3 here = vec3(dot3(abs3(vec3(x)), size) + abs(x.w), dot3(abs3(vec3(y)), size) + abs(y.w),
                   dot3(abs3(vec3(z)), size) + abs(z.w));
  size = abs3(surface.p) + abs3(object_center(s));
  vec3 back = vec3(dot3(abs3(object_x(s)), size), dot3(abs3(object_y(s)), size), dot3(abs3(object_z(s)), size));
  surface.offset = 4.0f * EPSILON * (dot3(abs3(surface.normal_geometric), here) + dot3(abs3(gradient), back) / slope);
  return surface;
}

// A point of the world in object space.
vec3 point_into_object(Primitive s, vec3 p) { return into_object(s, p - object_center(s)); }

// The distance inside of edges, in the world, at which rays start from the point p of object space, on a surface with this `offset` (geometry/edges.glsl).
float object_room(Primitive s, Ray ray, vec3 p, float offset) {
  vec4 x = bits_to_floats(load_vertex(s.extra));
  vec4 y = bits_to_floats(load_vertex(s.extra + 1u));
  vec4 z = bits_to_floats(load_vertex(s.extra + 2u));
  vec3 size = abs3(p);
  vec3 reach = vec3(dot3(abs3(vec3(x)), size), dot3(abs3(vec3(y)), size), dot3(abs3(vec3(z)), size));
  return edge_room(ray, max_component(reach) + 2.0f * max_component(abs3(object_center(s))), offset);
}

// The increase of a function of object space by a step of 1 in the world along its gradient.
float steepness(Primitive s, vec3 gradient) {
  vec3 n = gradient_out_of_object(s, gradient);
  return sqrt(dot3(n, n));
}

// The steepness of the three coordinates.
vec3 coordinate_steepness(Primitive s) {
  return vec3(sqrt(dot3(object_x(s), object_x(s))), sqrt(dot3(object_y(s), object_y(s))), sqrt(dot3(object_z(s), object_z(s))));
}

// A level, the gradient and the value of a function that is below 0 inside of a shape, brought from object space into the world.
vec4 level_out_of_object(Primitive s, vec3 gradient, float value) { return vec4(gradient_out_of_object(s, gradient), value); }

// The level of the intersection of two shapes in the world: that whose zero is farther outside.
vec4 outer_level(vec4 a, vec4 b) {
  return a.w * sqrt(dot3(vec3(b), vec3(b))) > b.w * sqrt(dot3(vec3(a), vec3(a))) ? a : b;
}

// A displacement in object space, in the world.
vec3 step_out_of_object(Primitive s, vec3 d) {
  return vec3(dot3(vec3(bits_to_floats(load_vertex(s.extra))), d), dot3(vec3(bits_to_floats(load_vertex(s.extra + 1u))), d),
              dot3(vec3(bits_to_floats(load_vertex(s.extra + 2u))), d));
}

SHADER_END
#endif
