// |x| = 1 in object space (emitters/object_map.glsl).
#ifndef EMITTER_ELLIPSOID_GLSL
#define EMITTER_ELLIPSOID_GLSL
#include "emitters/object_map.glsl"
#include "emitters/sphere.glsl"

SHADER_BEGIN

// The ellipsoid in object space: a sphere.
Primitive unit_sphere() {
  return primitive_of(uvec4(0u, 0u, 0u, 0u), vec4(0.0f, 0.0f, 0.0f, 1.0f), vec4(0.0f, 1.0f, 0.0f, 0.0f), vec4(1.0f, 0.0f, 0.0f, 1.0f));
}

EmitterSample ellipsoid_emitter_sample(Emitter e, vec3 from, vec2 u) {
  ObjectMap map = object_map(e);
  EmitterSample own = sample_sphere(unit_sphere(), map_into_object(map, from - map.center), u);
  EmitterSample point;
  point.p = map_out_of_object(map, own.p);
  point.normal = normalize3(map_normal(map, own.normal));
  point.uv = own.uv;
  return point;
}

float ellipsoid_emitter_density(Emitter e, vec3 from, EmitterSample point) {
  ObjectMap map = object_map(e);
  vec3 from_there = map_into_object(map, from - map.center);
  // From outside: solid angles in object space and in the world.
  vec3 direction = normalize3(point.p - from);
  vec3 stretched = map_into_object(map, direction);
  float squared = dot3(stretched, stretched);
  float cone = 1.0f / (2.0f * PI * versine(1.0f / dot3(from_there, from_there)));
  float by_angle = cone / (abs(map.volume) * (squared * sqrt(squared)));
  // From inside: areas.
  vec3 image = map_normal(map, normal_in_object(map, point.normal));
  float by_area = density_of_area(4.0f * PI * sqrt(dot3(image, image)), from, point);
  return sphere_is_seen_from_outside(unit_sphere(), from_there) ? by_angle : by_area;
}

SHADER_END
#endif
