// The map from object space to the world of an emitter that is a plain shape in object space.
#ifndef OBJECT_MAP_GLSL
#define OBJECT_MAP_GLSL
#include "emitters/emitter_sample.glsl"

SHADER_BEGIN

vec3 emitter_axis_x(Emitter e) { return vec3(e.a.x, e.b.x, e.c.x); }  // the images of the axes
vec3 emitter_axis_y(Emitter e) { return vec3(e.a.y, e.b.y, e.c.y); }
vec3 emitter_axis_z(Emitter e) { return vec3(e.a.z, e.b.z, e.c.z); }
vec3 emitter_center(Emitter e) { return vec3(e.a.w, e.b.w, e.c.w); }

struct ObjectMap {
  vec3 x;  // the images of the axes, …
  vec3 y;
  vec3 z;
  vec3 across_x;  // … perpendicular to two of them, as long as their parallelogram's area, …
  vec3 across_y;
  vec3 across_z;
  float volume;  // … and the determinant
  vec3 center;
};

ObjectMap object_map(Emitter e) {
  ObjectMap map;
  map.x = emitter_axis_x(e);
  map.y = emitter_axis_y(e);
  map.z = emitter_axis_z(e);
  map.across_x = cross3(map.y, map.z);
  map.across_y = cross3(map.z, map.x);
  map.across_z = cross3(map.x, map.y);
  map.volume = dot3(map.x, map.across_x);
  map.center = emitter_center(e);
  return map;
}

vec3 map_into_object(ObjectMap map, vec3 v) {
  return vec3(dot3(map.across_x, v), dot3(map.across_y, v), dot3(map.across_z, v)) / map.volume;
}
vec3 map_out_of_object(ObjectMap map, vec3 p) { return map.center + (map.x * p.x + map.y * p.y + map.z * p.z); }

// Normals map by the cofactors: n's image is as long as areas across n are stretched.
vec3 map_normal(ObjectMap map, vec3 n) {
  vec3 image = map.across_x * n.x + map.across_y * n.y + map.across_z * n.z;
  return map.volume < 0.0f ? -image : image;
}
// The unit normal there of a unit normal here.
vec3 normal_in_object(ObjectMap map, vec3 n) { return normalize3(vec3(dot3(map.x, n), dot3(map.y, n), dot3(map.z, n))); }

SHADER_END
#endif
