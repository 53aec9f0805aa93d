// f(x, y, z) = A x² + B y² + C z² + D xy + E xz + F yz + G x + H y + J z + K ≤ 0 within the cube from −1 to 1 of object space
// (geometry/object_space.glsl), the largest of the coefficients ±1.   Parameters: A, B, C, 1 where the cube is no cap; D, E, F, K; G, H, J
#ifndef QUADRIC_GLSL
#define QUADRIC_GLSL
#include "geometry/clipped_quadric.glsl"
#include "geometry/cube.glsl"

SHADER_BEGIN

#define QUADRIC_REACH 1.7320508f
#define QUADRIC_ITSELF 3.0f

struct Quadric {
  vec4 squares;
  vec4 products;
  vec4 linear;
};

Quadric load_quadric(Primitive s) {
  Quadric quadric;
  quadric.squares = object_parameters(s);
  quadric.products = bits_to_floats(load_vertex(s.extra + OBJECT_PARAMETERS + 1u));
  quadric.linear = bits_to_floats(load_vertex(s.extra + OBJECT_PARAMETERS + 2u));
  return quadric;
}

// The gradient of the terms of degree two: 2 Q v.
vec3 quadric_slope(vec3 squares, vec3 products, vec3 v) {
  return vec3(2.0f * squares.x * v.x + products.x * v.y + products.y * v.z,
              2.0f * squares.y * v.y + products.x * v.x + products.z * v.z,
              2.0f * squares.z * v.z + products.y * v.x + products.z * v.y);
}

vec3 quadric_equation(Quadric quadric, ObjectRay r) {
  vec3 linear = vec3(quadric.linear);
  vec3 along = quadric_slope(vec3(quadric.squares), vec3(quadric.products), r.d);
  vec3 here = quadric_slope(vec3(quadric.squares), vec3(quadric.products), r.o);
  return vec3(0.5f * dot3(along, r.d), 0.5f * (dot3(along, r.o) + dot3(linear, r.d)),
              (0.5f * dot3(here, r.o) + dot3(linear, r.o)) + quadric.products.w);
}

// From p on a face of the cube to the inside of the face's edges and of the quadric, by Newton's steps.
vec3 quadric_inward_of_face(Primitive s, vec3 p, vec2 face, float room) {
  Quadric quadric = load_quadric(s);
  vec3 inward = vec3(0.0f, 0.0f, 0.0f);
  for (uint i = 0u; i < 3u; i++) {
    vec3 at = p + inward;
    vec3 bend = quadric_slope(vec3(quadric.squares), vec3(quadric.products), at);
    float f = (0.5f * dot3(bend, at) + dot3(vec3(quadric.linear), at)) + quadric.products.w;
    inward = inward + inward_of_cut_face(s, at, face, f, bend + vec3(quadric.linear), room);
  }
  return inward;
}

// The step in q's direction along a quadric that p is on: `along`, brought back onto it.
vec3 quadric_step(Quadric quadric, vec3 p, vec3 along) {
  vec3 slope = quadric_slope(vec3(quadric.squares), vec3(quadric.products), p) + vec3(quadric.linear);
  vec3 bend = quadric_slope(vec3(quadric.squares), vec3(quadric.products), along);
  float f = dot3(slope, along) + 0.5f * dot3(bend, along);
  return along - slope * (f / maximum(dot3(slope, slope), 1.0e-12f));
}

// uv: the axis and the side of the cube's face, or QUADRIC_ITSELF.
float quadric_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  Quadric quadric = load_quadric(s);
  ObjectRay r = object_ray(s, ray, QUADRIC_REACH);
  CubeSpan span = cube_span(r);
  float part = PART_QUADRIC;
  float nearest = clipped_quadric(ray, r.t, quadric_equation(quadric, r), nearest_at(r), quadric_equation(quadric, from_nearest(r)),
                                  span.enter, span.leave, quadric.squares.w != 0.0f, part);
  uv = part == PART_QUADRIC ? vec2(QUADRIC_ITSELF, 0.0f) : cube_face(span, r, part == PART_ENTRY);
  return nearest < T_MISS ? r.t + nearest : T_NONE;
}

bool quadric_reject(Primitive s, Ray ray) { return false; }

void quadric_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) { object_box(s, vec3(1.0f, 1.0f, 1.0f), lower, upper); }

vec4 quadric_level(Primitive s, vec3 p) {
  Quadric quadric = load_quadric(s);
  vec3 q = point_into_object(s, p);
  vec3 bend = quadric_slope(vec3(quadric.squares), vec3(quadric.products), q);
  float f = (0.5f * dot3(bend, q) + dot3(vec3(quadric.linear), q)) + quadric.products.w;
  return outer_level(level_out_of_object(s, bend + vec3(quadric.linear), f), cube_level(s, q));
}

Surface quadric_surface(Primitive s, Ray ray, Hit hit) {
  vec3 p = at_hit(object_ray(s, ray, QUADRIC_REACH), hit);
  if (hit.uv.x != QUADRIC_ITSELF) {
    p = onto_cube(p, hit.uv);
    Surface face = object_surface(s, p, cube_normal(hit.uv), cube_uv(p, hit.uv));
    face.inward = step_out_of_object(s, quadric_inward_of_face(s, p, hit.uv, object_room(s, ray, p, face.offset)));
    return face;
  }

  // Step onto it along the gradient. `noise`: how far off f may be by rounding. Where the gradient is as good as 0, as at an apex, f is a
  // square: its root is that far off.
  Quadric quadric = load_quadric(s);
  vec3 squares = vec3(quadric.squares);
  vec3 products = vec3(quadric.products);
  vec3 linear = vec3(quadric.linear);
  vec3 bend = quadric_slope(squares, products, p);
  float f = (0.5f * dot3(bend, p) + dot3(linear, p)) + quadric.products.w;
  vec3 size = abs3(p);
  float terms = 0.5f * dot3(quadric_slope(abs3(squares), abs3(products), size), size) + dot3(abs3(linear), size);
  float noise = maximum(4.0f * EPSILON * (terms + abs(quadric.products.w)), EPSILON * EPSILON);
  vec3 gradient = bend + linear;
  p = into_cube(p - gradient * (f / maximum(dot3(gradient, gradient), noise)));
  gradient = quadric_slope(squares, products, p) + linear;
  float squared = dot3(gradient, gradient);
  float least = sqrt(noise / maximum(squared, 1.0e-30f));
  gradient = squared > 0.0f ? gradient * maximum(least, 1.0f) : vec3(0.0f, sqrt(noise), 0.0f);

  // The uv are those of the face that the normal points to.
  vec3 facing = abs3(gradient);
  float axis = facing.x >= facing.y && facing.x >= facing.z ? 0.0f : facing.y >= facing.z ? 1.0f : 2.0f;
  float towards = axis == 0.0f ? gradient.x : axis == 1.0f ? gradient.y : gradient.z;
  Surface surface = object_surface(s, p, gradient, cube_uv(p, vec2(axis, towards < 0.0f ? -1.0f : 1.0f)));
  vec3 slope = gradient_out_of_object(s, gradient);
  surface.offset = surface.offset + noise / sqrt(dot3(slope, slope));
  vec3 inward = inward_of_cut(s, p, gradient, object_room(s, ray, p, surface.offset));
  surface.inward = step_out_of_object(s, quadric_step(quadric, p, inward));
  return surface;
}

SHADER_END
#endif
