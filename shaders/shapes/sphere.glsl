// |x − c| = r.
// Roots after Haines, Günther and Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection" (Ray Tracing Gems, 7).
#ifndef SPHERE_GLSL
#define SPHERE_GLSL
#include "geometry/ray.glsl"
#include "geometry/uv_field.glsl"
#include "records.h"

SHADER_BEGIN

vec3 sphere_center(Primitive s) { return vec3(s.a); }
float sphere_radius(Primitive s) { return s.a.w; }
vec3 sphere_pole(Primitive s) { return vec3(s.b); }  // where v = 1
vec3 sphere_meridian(Primitive s) { return vec3(s.c); }  // where u = ½
float sphere_handedness(Primitive s) { return s.c.w; }

// The distance of the ray's line from the centre decides: r² less its square, measured as a distance.
float sphere_discriminant(Primitive s, Ray ray) {
  vec3 f = ray.o - sphere_center(s);
  float inverse_a = 1.0f / dot3(ray.d, ray.d);  // the same for every sphere, and so divided once
  vec3 nearest = f + ray.d * (-dot3(f, ray.d) * inverse_a);
  return sphere_radius(s) * sphere_radius(s) - dot3(nearest, nearest);
}

float sphere_intersect(Primitive s, Ray ray, OUT(vec2) uv) {
  uv = vec2(0.0f, 0.0f);
  vec3 f = ray.o - sphere_center(s);
  float a = dot3(ray.d, ray.d);
  float b = -dot3(f, ray.d);
  float discriminant = sphere_discriminant(s, ray);

  // Take the root without cancellation first; the product of the roots gives the other.
  float c = dot3(f, f) - sphere_radius(s) * sphere_radius(s);
  float root = sqrt(maximum(a * discriminant, 0.0f));
  float q = b < 0.0f ? b - root : b + root;
  float t0 = c / q;
  float t1 = q * (1.0f / a);
  float low = t0 < t1 ? t0 : t1;
  float high = t0 < t1 ? t1 : t0;
  float t = ENTERS(ray, low) ? low : high;
  return discriminant > 0.0f ? t : T_NONE;
}

// Longitude and latitude of the unit normal n.
vec2 sphere_uv(Primitive s, vec3 n) {
  vec3 pole = sphere_pole(s);
  vec3 meridian = sphere_meridian(s);
  float x = dot3(n, meridian);
  float y = dot3(n, pole);
  float z = dot3(n, cross3(meridian, pole)) * sphere_handedness(s);
  float u = 0.5f + atan_yx(-z, x) / (2.0f * PI);
  return vec2(u < 1.0f ? u : 0.0f, atan_yx(sqrt(x * x + z * z), -y) / PI);
}

void set_sphere_gradients(Primitive s, vec3 n, INOUT(Surface) surface) {
  vec3 pole = sphere_pole(s);
  vec3 meridian = sphere_meridian(s);
  vec3 third = cross3(meridian, pole) * sphere_handedness(s);
  vec3 own = vec3(dot3(n, meridian), dot3(n, pole), dot3(n, third));
  vec3 u = turn_gradient(own) / sphere_radius(s);
  vec3 v = pole_gradient(own) / (PI * sphere_radius(s));
  set_gradients(surface, meridian * u.x + pole * u.y + third * u.z, meridian * v.x + pole * v.y + third * v.z);
}

bool sphere_reject(Primitive s, Ray ray) { return !(sphere_discriminant(s, ray) >= 0.0f); }

void sphere_box(Primitive s, OUT(vec3) lower, OUT(vec3) upper) {
  float r = sphere_radius(s);
  lower = sphere_center(s) - vec3(r, r, r);
  upper = sphere_center(s) + vec3(r, r, r);
}

vec4 sphere_level(Primitive s, vec3 p) {
  vec3 f = (p - sphere_center(s)) / sphere_radius(s);
  return vec4(f, 0.5f * sphere_radius(s) * (dot3(f, f) - 1.0f));
}

vec3 sphere_normal(Primitive s, Ray ray, Hit hit) {
  // A sphere smaller than the rounding of its distance may be hit at its very centre.
  vec3 from_centre = (ray.o - sphere_center(s)) + ray.d * hit.t;
  return dot3(from_centre, from_centre) > 0.0f ? normalize3(from_centre) : -ray.d;
}

// The surface at a hit with the normal n, with uv 0 and without their gradients.
Surface sphere_surface_at(Primitive s, vec3 n) {
  Surface surface;
  surface.p = sphere_center(s) + n * sphere_radius(s);
  surface.normal_geometric = n;
  surface.normal = n;
  surface.uv = vec2(0.0f, 0.0f);
  surface.offset = 4.0f * EPSILON * (dot3(abs3(n), abs3(sphere_center(s))) + sphere_radius(s));
  return surface;
}

Surface sphere_surface(Primitive s, Ray ray, Hit hit) {
  vec3 n = sphere_normal(s, ray, hit);
  Surface surface = sphere_surface_at(s, n);
  if (UV_OF(sphere)) surface.uv = sphere_uv(s, n);
  set_sphere_gradients(s, n, surface);
  return surface;
}

SHADER_END
#endif
